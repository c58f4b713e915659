// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/point_cloud.hpp"

namespace loop_metric {

/// The first and the last frame of odometry on the way from `way` m before a moment to `way` m behind it, and at most 20 s from it, however little the robot moved.
std::pair<urban_nav_core::StampNs, urban_nav_core::StampNs> stretchAround(const urban_nav_core::OdometryChain& odometry,
                                                                          urban_nav_core::StampNs at, double way);

/// A laser, and whoever has its scans.
struct LaserScans {
  urban_nav_core::Pose T_base_laser;
  /// Hands over those of a stretch of time, both ends with it, in order of time.
  std::function<void(urban_nav_core::StampNs first, urban_nav_core::StampNs last,
                     const std::function<void(const urban_nav_core::Scan&)>& take)>
      forEach;
};

/// What the lasers saw on the stretch around a moment, rendered beam by beam along odometry, with the origins of the beams, in base_link's frame at the moment (Newman et al. 2009,
/// section 4.2). Empty where odometry does not know the moment. At most 400 000 points, evenly chosen.
urban_nav_core::PointCloud localCloud(const urban_nav_core::OdometryChain& odometry, urban_nav_core::StampNs at,
                                      double way, const std::vector<LaserScans>& lasers);

/// By how much odometry's drift bends that cloud, m: the deviation of its points from where they would lie beside the others.
double bendOf(const urban_nav_core::OdometryChain& odometry, urban_nav_core::StampNs at, double way);

}  // namespace loop_metric
