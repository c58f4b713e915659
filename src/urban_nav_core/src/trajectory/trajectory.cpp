// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/trajectory.hpp"

#include <algorithm>
#include <cassert>
#include <ostream>

#include "urban_nav_core/trajectory/interpolate.hpp"

namespace urban_nav_core {

Trajectory::Trajectory(std::vector<StampedPose> poses) : poses_(std::move(poses)) {
  assert(std::adjacent_find(poses_.begin(), poses_.end(), [](const StampedPose& a, const StampedPose& b) {
           return b.stamp <= a.stamp;
         }) == poses_.end());
}

bool Trajectory::append(StampNs stamp, const Pose& pose) {
  if (!poses_.empty() && stamp <= poses_.back().stamp) return false;
  poses_.push_back({stamp, pose});
  return true;
}

std::optional<Pose> Trajectory::at(StampNs stamp, StampNs max_gap) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), stamp,
                                      [](const StampedPose& pose, StampNs wanted) { return pose.stamp < wanted; });
  if (after == poses_.end()) return std::nullopt;
  if (after->stamp == stamp) return after->pose;
  if (after == poses_.begin()) return std::nullopt;
  const StampedPose& before = *(after - 1);
  const double gap = secondsBetween(before.stamp, after->stamp);
  if (gap > static_cast<double>(max_gap) * 1e-9) return std::nullopt;
  return interpolate(before.pose, after->pose, secondsBetween(before.stamp, stamp) / gap);
}

std::size_t Trajectory::nearest(StampNs stamp) const {
  assert(!poses_.empty());
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), stamp,
                                      [](const StampedPose& pose, StampNs wanted) { return pose.stamp < wanted; });
  const auto index = static_cast<std::size_t>(after - poses_.begin());
  if (index == 0) return 0;
  if (after == poses_.end()) return poses_.size() - 1;
  return secondsBetween(poses_[index - 1].stamp, stamp) <= secondsBetween(stamp, after->stamp) ? index - 1 : index;
}

double Trajectory::length() const {
  double sum = 0.0;
  for (std::size_t i = 1; i < poses_.size(); ++i) sum += distanceBetween(poses_[i - 1].pose, poses_[i].pose);
  return sum;
}

Trajectory transformed(const Pose& T_new_world, const Trajectory& trajectory) {
  std::vector<StampedPose> poses;
  poses.reserve(trajectory.size());
  for (const StampedPose& each : trajectory) poses.push_back({each.stamp, T_new_world * each.pose});
  return Trajectory(std::move(poses));
}

bool isApprox(const Trajectory& a, const Trajectory& b, double tolerance) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [tolerance](const StampedPose& x, const StampedPose& y) {
    return x.stamp == y.stamp && isApprox(x.pose, y.pose, tolerance);
  });
}

std::ostream& operator<<(std::ostream& out, const Trajectory& trajectory) {
  if (trajectory.empty()) return out << "no poses";
  return out << trajectory.size() << " poses from " << printStamp(trajectory.front().stamp) << " to "
             << printStamp(trajectory.back().stamp) << " s, " << trajectory.length() << " m";
}

}  // namespace urban_nav_core
