// SPDX-License-Identifier: BSD-3-Clause
#include "odom_tie.hpp"

#include <algorithm>

namespace pose_graph {

namespace {

// A stamp that lies this far back is a bag that began again or a clock that was set, not a late message.
constexpr StampNs kTieBack = 1'000'000'000;
// Odometry of which the graph hears nothing: 10 minutes at 20 Hz, after which it will not come any more.
constexpr std::size_t kMost = 12'000;

constexpr double kRoundOff = 1e-9;  // m, rad: noise of a robot that stands still is far above it

bool isIdentity(const Pose& pose) { return isApprox(pose, Pose(), kRoundOff); }

}  // namespace

void OdomTie::hear(const urban_nav_core::StampedPose& odometry) {
  const bool back = !heard_.empty() && odometry.stamp < heard_.rbegin()->first - kTieBack;
  const bool anew = isIdentity(odometry.pose) && (heard_.empty() || !isIdentity(heard_.rbegin()->second));
  if (back || anew) {
    heard_.clear();
    begins_ = anew;
    if (back) ended_ = session_;
    T_map_odom_.reset();
  }
  heard_[odometry.stamp] = odometry.pose;
  if (heard_.size() > kMost) heard_.erase(heard_.begin());
}

void OdomTie::forgetSessions() {
  session_.clear();
  ended_.clear();
}

std::optional<Pose> OdomTie::T_map_odom(const Track* running) {
  session_ = running != nullptr ? running->session : SessionId();
  const bool any = running != nullptr && !running->stamps.empty() && running->session != ended_;
  if (any && !heard_.empty()) {
    const auto& stamps = running->stamps;
    auto behind = std::upper_bound(stamps.begin(), stamps.end(), heard_.rbegin()->first);
    for (; behind != stamps.begin() && *(behind - 1) >= heard_.begin()->first; --behind) {
      const auto found = heard_.find(*(behind - 1));
      if (found == heard_.end()) continue;
      T_map_odom_ = running->map[static_cast<std::size_t>(behind - 1 - stamps.begin())] * found->second.inverse();
      begins_ = false;
      heard_.erase(heard_.begin(), found);
      return T_map_odom_;
    }
  }
  if (begins_) T_map_odom_ = any ? running->map.back() : Pose();
  return T_map_odom_;
}

}  // namespace pose_graph
