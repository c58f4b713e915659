// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_registration {

/// Parameters of registration, shared by all stages that use it; one member per row of table().
struct Parameters {
  // keyframes and odometry
  double keyframe_distance;  // m
  double keyframe_angle;     // rad
  double cloud_half_length;  // m
  double odometry_scale;     // share
  // stereo
  int points;                     // per keyframe
  int min_matches;                // of an accepted transform
  double max_reprojection_error;  // px, mean
  double min_patch_correlation;   // mean correlation
  double disparity_offset;        // px
  double pixel_noise_floor;       // px
  // clouds
  double voxel_size;                     // m
  double max_correspondence_distance;    // m
  int iterations;                        // per level
  double laser_bias;                     // m
  double free_deviation;                 // m
  double max_residual;                   // m
  double inlier_distance;                // m
  double min_inliers;                    // share
  double min_vertical_inliers;           // share
  double max_residual_ratio;             // multiple of the expected residual
  double max_unmodelled_residual_ratio;  // multiple of the expected residual
  double min_overlap;                    // share
  double max_free_space_violation;       // share
  int min_surfels;                       // with a counterpart
  double search_radius;                  // m
  double max_second_best_ratio;          // share

  Parameters();
};

/// The parameter table: the single source of defaults, ranges, units and descriptions.
const urban_nav_core::Table<Parameters>& table();

}  // namespace urban_nav_registration
