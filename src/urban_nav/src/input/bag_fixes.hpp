// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

/// A position that a GPS receiver measured.
struct GpsReading {
  urban_nav_core::StampNs stamp = 0;
  double latitude = 0.0, longitude = 0.0;                             ///< deg, WGS 84
  double height = 0.0;                                                ///< m over the ellipsoid
  urban_nav_core::Vector3d sigma = urban_nav_core::Vector3d::Ones();  ///< m, east, north, up
};

/// The fixes of a session.
struct BagFixes {
  std::string topic;  ///< empty: the bags have none
  std::vector<GpsReading> readings;
  urban_nav_core::Vector3d p_base = urban_nav_core::Vector3d::Zero();  ///< m, of the antenna
  bool is_placed = false;                                              ///< by /tf_static; otherwise at base_link
};

/// Reads the fixes of the bags of one session, in the order of the bags. `topics`: wishes, as chooseTopics() takes
/// them. Messages without a fix, or with numbers that are not finite, are left out. An unknown covariance counts as 5
/// m, and 10 m up. Nothing if `paths` are no bags. Throws DataError for a damaged bag.
BagFixes readBagFixes(const std::vector<std::string>& paths, const std::vector<std::string>& topics);

}  // namespace urban_nav
