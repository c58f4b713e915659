// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/point_cloud.hpp"

namespace urban_nav_registration {

/// Returns the first and the last frame of odometry within a path of `half_length` (m) before and after a stamp, and
/// within 20 s of it.
std::pair<urban_nav_core::StampNs, urban_nav_core::StampNs> stretchAround(const urban_nav_core::OdometryChain& odometry,
                                                                          urban_nav_core::StampNs at,
                                                                          double half_length);

/// A laser with access to its scans.
struct LaserScans {
  urban_nav_core::Pose T_base_laser;
  /// Calls `take` with the scans from `first` to `last`, both included, in order of time.
  std::function<void(urban_nav_core::StampNs first, urban_nav_core::StampNs last,
                     const std::function<void(const urban_nav_core::Scan&)>& take)>
      forEach;
};

/// Returns the points of the lasers within that path of a stamp, computed beam by beam along odometry, with the
/// origins of the beams, in base_link at the stamp (Newman et al. 2009, section 4.2). Empty if odometry does not cover
/// the stamp. Evenly thinned to at most 400 000 points.
urban_nav_core::PointCloud localCloud(const urban_nav_core::OdometryChain& odometry, urban_nav_core::StampNs at,
                                      double half_length, const std::vector<LaserScans>& lasers);

/// Returns the deformation of a local cloud by the drift of odometry: the standard deviation of its points relative to
/// the others, m.
double deformationSigma(const urban_nav_core::OdometryChain& odometry, urban_nav_core::StampNs at, double half_length);

}  // namespace urban_nav_registration
