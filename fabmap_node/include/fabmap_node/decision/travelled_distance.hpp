// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace fabmap_node {

/// Distance travelled in a session, by odometry. Not thread-safe.
class TravelledDistance {
 public:
  /// Adds a position in `odom`, m; stamps must ascend, others are ignored.
  void add(urban_nav_core::StampNs stamp, const Eigen::Vector3d& position);
  /// Returns the distance travelled up to a stamp, m, interpolated; 0 before the first position, constant after the
  /// last one.
  double at(urban_nav_core::StampNs stamp) const;
  bool empty() const { return stamps_.empty(); }
  /// Returns the last stamp. Requires at least one position.
  urban_nav_core::StampNs last() const { return stamps_.back(); }

 private:
  std::vector<urban_nav_core::StampNs> stamps_;
  std::vector<double> distances_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
};

}  // namespace fabmap_node
