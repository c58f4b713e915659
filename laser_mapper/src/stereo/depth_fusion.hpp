// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "laser_mapper/depth_frame.hpp"

namespace laser_mapper {

/// Depth image with its pose. The image must outlive it.
struct PosedDepth {
  const DepthFrame* frame = nullptr;
  urban_nav_core::Pose T_frame_camera;  ///< to the frame of returned points
};

/// Point on which several depth images agree.
struct FusedPoint {
  Eigen::Vector3f p = Eigen::Vector3f::Zero();  ///< m
  float sigma = 0.0F;                           ///< m, standard deviation along the line of sight
  float grey = 0.0F;                            ///< 0...255
  int views = 0;                                ///< images that agree, including its own
};

/// Criteria for points on which depth images agree.
struct FusionRule {
  int fewest_views = 3;      ///< images that must observe the point, including its own
  float farthest = 40.0F;    ///< m, depth of a point in its own image
  float sigma_limit = 0.1F;  ///< m, standard deviation of a fused point along the line of sight
};

/// Returns the points of one depth image that others confirm (Merrell et al. 2007). A sample is moved along its line of
/// sight to the mean depth of all images that agree with it, weighted by inverse variance. It is rejected if fewer than
/// FusionRule::fewest_views agree, or if at least half as many images see through it as agree. `others`: may include
/// the image itself, which is skipped. Thread-safe.
std::vector<FusedPoint> fuseDepth(const PosedDepth& own, const std::vector<PosedDepth>& others, const FusionRule& rule);

}  // namespace laser_mapper
