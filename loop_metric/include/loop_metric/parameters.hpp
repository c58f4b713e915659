// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"

namespace loop_metric {

/// What a user may want to change; one member per row of table().
struct Parameters {
  // candidates
  double keyframe_way;    // m
  double keyframe_turn;   // rad
  bool stereo;            // try it
  bool icp;               // try it where stereo fails
  int stereo_tries;       // pairs of views
  double view_way;        // m
  double cloud_way;       // m
  double place_radius;    // m
  double gate;            // standard deviations
  double map_sigma;       // m
  double odometry_scale;  // share
  // stereo
  int points;                     // of a keyframe
  int min_matches;                // to accept
  double max_reprojection_error;  // px, mean
  double min_likeness;            // mean correlation
  double disparity_offset;        // px
  double pixel_noise_floor;       // px
  // clouds
  double voxel;                // m
  double reach;                // m
  int iterations;              // of one step from coarse to fine
  double laser_bias;           // m
  double free_deviation;       // m
  double max_residual;         // m
  double inlier_distance;      // m
  double min_inliers;          // share
  double min_upright_inliers;  // share
  double max_misfit;           // of what noise explains
  double max_unknown_misfit;   // the same
  double min_shared;           // share
  double max_seen_through;     // share
  int min_surfels;             // with a counterpart
  double search_radius;        // m
  double max_second;           // share

  Parameters();
};

/// The table: the only place where a default, a range, a unit or a sentence about a parameter stands.
const urban_nav_core::Table<Parameters>& table();

}  // namespace loop_metric
