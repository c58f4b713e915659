// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"

namespace swf_vo {

/// User parameters; one member per row of table(), which has description, unit, range and default. Camera and
/// extrinsics come with the data.
struct Parameters {
  int window;                // frames
  int features;              // in an image of 512x384
  double pixel_noise_floor;  // px
  double disparity_offset;   // px, standard deviation of a state; 0: none
  double rig_scale;          // %, standard deviation
  double right_roll;         // deg, standard deviation of the prior
  double shutter_delay;      // ms, standard deviation of the prior
  bool robust_covariance;
  double huber;                 // standard deviations
  int iterations;               // Gauss-Newton steps a frame, at most
  double acceleration;          // m/s^2, process noise without u
  double angular_acceleration;  // rad/s^2
  double search_radius;         // px
  int pyramid_levels;
  int fast_threshold;  // grey levels
  int lost_features;   // fewer inliers than this: prediction only
  int degraded_features;

  Parameters();
};

/// The parameter table: the single source of defaults, ranges, units and descriptions.
const urban_nav_core::Table<Parameters>& table();

}  // namespace swf_vo
