// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/decision/travelled_distance.hpp"

#include <algorithm>

namespace fabmap_node {

using urban_nav_core::StampNs;

void TravelledDistance::add(StampNs stamp, const Eigen::Vector3d& position) {
  if (!position.allFinite() || (!stamps_.empty() && stamp <= stamps_.back())) return;
  distances_.push_back(stamps_.empty() ? 0.0 : distances_.back() + (position - position_).norm());
  stamps_.push_back(stamp);
  position_ = position;
}

double TravelledDistance::at(StampNs stamp) const {
  const auto after = std::upper_bound(stamps_.begin(), stamps_.end(), stamp);
  if (after == stamps_.begin()) return 0.0;
  const auto i = static_cast<std::size_t>(after - stamps_.begin()) - 1;
  if (i + 1 == stamps_.size()) return distances_.back();
  const double share = static_cast<double>(stamp - stamps_[i]) / static_cast<double>(stamps_[i + 1] - stamps_[i]);
  return distances_[i] + share * (distances_[i + 1] - distances_[i]);
}

}  // namespace fabmap_node
