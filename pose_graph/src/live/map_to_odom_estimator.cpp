// SPDX-License-Identifier: BSD-3-Clause
#include "live/map_to_odom_estimator.hpp"

#include <algorithm>

#include "urban_nav_live/time_jump.hpp"

namespace pose_graph {

namespace {

// Limit of odometry without a matching pose of the graph: 10 minutes at 20 Hz.
constexpr std::size_t kMaxOdometry = 12'000;

constexpr double kRoundOff = 1e-9;  // m, rad; far below the noise of a standing robot

bool isIdentity(const Pose& pose) { return isApprox(pose, Pose(), kRoundOff); }

}  // namespace

void MapToOdomEstimator::addOdometry(const urban_nav_core::StampedPose& odometry) {
  const bool back = !odometry_.empty() && odometry.stamp < odometry_.rbegin()->first - urban_nav_live::kMaxStepBack;
  const bool restarted = isIdentity(odometry.pose) && (odometry_.empty() || !isIdentity(odometry_.rbegin()->second));
  if (back || restarted) {
    odometry_.clear();
    starts_at_identity_ = restarted;
    if (back) ended_session_ = session_;
    T_map_odom_.reset();
  }
  odometry_[odometry.stamp] = odometry.pose;
  if (odometry_.size() > kMaxOdometry) odometry_.erase(odometry_.begin());
}

void MapToOdomEstimator::forgetSessions() {
  session_.clear();
  ended_session_.clear();
}

std::optional<Pose> MapToOdomEstimator::estimate(const Track* running) {
  session_ = running != nullptr ? running->session : SessionId();
  const bool any = running != nullptr && !running->stamps.empty() && running->session != ended_session_;
  if (any && !odometry_.empty()) {
    const auto& stamps = running->stamps;
    auto next = std::upper_bound(stamps.begin(), stamps.end(), odometry_.rbegin()->first);
    for (; next != stamps.begin() && *(next - 1) >= odometry_.begin()->first; --next) {
      const auto found = odometry_.find(*(next - 1));
      if (found == odometry_.end()) continue;
      T_map_odom_ = running->map[static_cast<std::size_t>(next - 1 - stamps.begin())] * found->second.inverse();
      starts_at_identity_ = false;
      odometry_.erase(odometry_.begin(), found);
      return T_map_odom_;
    }
  }
  if (starts_at_identity_) T_map_odom_ = any ? running->map.back() : Pose();
  return T_map_odom_;
}

}  // namespace pose_graph
