// SPDX-License-Identifier: BSD-3-Clause
#include "window/state.hpp"

#include <algorithm>

namespace swf_vo {

namespace {

// A track is seldom longer than this; longer ones grow by doubling.
constexpr std::size_t usual_track = 16;
constexpr std::size_t fewest_slots = 64;

bool before(const std::pair<LandmarkId, int>& entry, LandmarkId id) { return entry.first < id; }

}  // namespace

int State::poseOf(FrameId frame) const {
  const auto at = std::lower_bound(poses.begin(), poses.end(), frame,
                                   [](const PoseBlock& pose, FrameId value) { return pose.frame < value; });
  return at != poses.end() && at->frame == frame ? static_cast<int>(at - poses.begin()) : -1;
}

int State::slotOf(LandmarkId landmark) const {
  const auto at = std::lower_bound(slots_.begin(), slots_.end(), landmark, before);
  return at != slots_.end() && at->first == landmark ? at->second : -1;
}

void State::reserveLike(const State& other) {
  poses.reserve(other.poses.capacity());
  slots_.reserve(other.slots_.capacity());
  free_.reserve(other.free_.capacity());
  landmarks.resize(other.landmarks.size());
  for (std::size_t i = 0; i < landmarks.size(); ++i) landmarks[i].seen.reserve(other.landmarks[i].seen.capacity());
}

void State::reserve(std::size_t slots) {
  const std::size_t had = landmarks.size();
  if (slots <= had) return;
  landmarks.resize(slots);
  slots_.reserve(slots);
  free_.reserve(slots);
  for (std::size_t slot = slots; slot-- > had;) {
    landmarks[slot].seen.reserve(usual_track);
    free_.push_back(static_cast<int>(slot));
  }
}

int State::add(LandmarkId landmark) {
  if (free_.empty()) reserve(std::max(fewest_slots, 2 * landmarks.size()));
  const int slot = free_.back();
  free_.pop_back();
  slots_.insert(std::lower_bound(slots_.begin(), slots_.end(), landmark, before), {landmark, slot});
  LandmarkBlock& block = landmarks[static_cast<std::size_t>(slot)];
  block.id = landmark;
  block.prior = -1;
  block.used = true;
  block.known = false;
  block.followed = true;
  block.seen.clear();
  return slot;
}

void State::remove(int slot) {
  LandmarkBlock& block = landmarks[static_cast<std::size_t>(slot)];
  slots_.erase(std::lower_bound(slots_.begin(), slots_.end(), block.id, before));
  block.used = false;
  block.prior = -1;
  block.seen.clear();
  free_.push_back(slot);
}

}  // namespace swf_vo
