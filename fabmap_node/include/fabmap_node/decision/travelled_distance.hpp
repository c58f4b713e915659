// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace fabmap_node {

/// Distance driven in a session, by odometry as it was at each time. Not thread-safe.
class TravelledDistance {
 public:
  /// Adds a position in `odom`, m; stamps ascend, others are ignored.
  void add(urban_nav_core::StampNs stamp, const Eigen::Vector3d& position);
  /// Returns the distance driven up to a stamp, m, interpolated; before the first position 0, after the last one its
  /// distance.
  double at(urban_nav_core::StampNs stamp) const;
  bool empty() const { return stamps_.empty(); }
  /// Returns the last stamp. Requires that it is not empty.
  urban_nav_core::StampNs last() const { return stamps_.back(); }

 private:
  std::vector<urban_nav_core::StampNs> stamps_;
  std::vector<double> distances_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
};

}  // namespace fabmap_node
