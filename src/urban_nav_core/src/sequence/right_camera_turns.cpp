// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/right_camera_turns.hpp"

#include <algorithm>
#include <memory>

namespace urban_nav_core {

namespace {

constexpr std::size_t kMostChanges = 1000;

}  // namespace

void RightCameraTurns::add(const StampedTurn& turn) {
  if (!turn.turn.allFinite() || (!changes_.empty() && turn.stamp <= last_)) return;
  last_ = turn.stamp;
  if (!changes_.empty() && changes_.back().turn == turn.turn) return;
  if (changes_.empty() && turn.turn.isZero(0.0)) return;
  changes_.push_back(turn);
  if (changes_.size() > kMostChanges) changes_.erase(changes_.begin());
}

void RightCameraTurns::correct(StereoPairWithMotion& frame) {
  const auto after = std::upper_bound(changes_.begin(), changes_.end(), frame.pair.stamp,
                                      [](StampNs stamp, const StampedTurn& turn) { return stamp < turn.stamp; });
  right_.set(after == changes_.begin() ? Vector3d(Vector3d::Zero()) : std::prev(after)->turn);
  if (right_.turn().isZero(0.0) || frame.pair.right.empty()) return;
  const auto pixels = std::make_shared<std::vector<std::uint8_t>>();
  frame.pair.right = right_.correct(frame.pair.right, *pixels);
  if (frame.pair.right.data == pixels->data()) frame.right_owner = pixels;
}

}  // namespace urban_nav_core
