// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/results/recorded_map.hpp"

#include <algorithm>

#include "urban_nav_core/types/frames.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_store::StoredTrajectory;

namespace {

constexpr StampNs kLongestPoseInterval = 1'000'000'000;  // ns between the two poses around a stamp

}  // namespace

RecordedMap::RecordedMap(const std::vector<StoredTrajectory>& map) {
  bool joined = false;
  for (const StoredTrajectory& each : map) {
    if (each.T_map_base.empty()) continue;
    const StampNs first = each.T_map_base.front().stamp, last = each.T_map_base.back().stamp;
    first_ = sessions_.empty() ? first : std::min(first_, first);
    last_ = sessions_.empty() ? last : std::max(last_, last);
    joined = joined || each.relaxed || each.map != each.session.id;
    sessions_.push_back(each);
    trajectories_.emplace_back(each.T_map_base);
  }
  frame_ = joined ? urban_nav_core::frames::kMap : urban_nav_core::frames::kOdom;
}

std::optional<urban_nav_core::Pose> RecordedMap::poseAt(const urban_nav_store::SessionId& session,
                                                        StampNs stamp) const {
  for (std::size_t i = 0; i < sessions_.size(); ++i)
    if (sessions_[i].session.id == session) return trajectories_[i].at(stamp, kLongestPoseInterval);
  return std::nullopt;
}

}  // namespace urban_nav
