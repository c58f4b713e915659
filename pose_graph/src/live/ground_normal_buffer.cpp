// SPDX-License-Identifier: BSD-3-Clause
#include "live/ground_normal_buffer.hpp"

#include <algorithm>
#include <utility>

namespace pose_graph {

namespace {

constexpr double kSpacing = 0.25, kTurn = 0.175;  // m, rad; as for the keyframes of `map`
constexpr std::size_t kMostNormals = 2000;        // 100 s at 20 Hz; odometry lags by a few frames

}  // namespace

void GroundNormalBuffer::add(const GroundNormal& normal) {
  if (waiting_.size() == kMostNormals) waiting_.pop_front();
  waiting_.push_back(normal);
}

std::vector<GroundNormal> GroundNormalBuffer::takeAt(const Track& track) {
  std::vector<GroundNormal> made;
  if (track.stamps.empty()) return made;
  std::deque<GroundNormal> waiting;
  for (const GroundNormal& normal : std::exchange(waiting_, {})) {
    if (normal.stamp > track.stamps.back()) {
      waiting.push_back(normal);
      continue;
    }
    const auto at = std::lower_bound(track.stamps.begin(), track.stamps.end(), normal.stamp);
    if (*at != normal.stamp || (last_ && normal.stamp <= last_->stamp)) continue;
    const Pose& pose = track.odom[static_cast<std::size_t>(at - track.stamps.begin())];
    const bool is_near =
        last_ && distanceBetween(last_->T_odom_base, pose) < kSpacing && angleBetween(last_->T_odom_base, pose) < kTurn;
    if (is_near) continue;
    last_ = Taken{normal.stamp, pose};
    made.push_back(normal);
  }
  waiting_ = std::move(waiting);
  return made;
}

}  // namespace pose_graph
