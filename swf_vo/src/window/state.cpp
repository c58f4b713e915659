// SPDX-License-Identifier: BSD-3-Clause
#include "window/state.hpp"

#include <algorithm>

namespace swf_vo {

namespace {

// Typical maximum length of a track; longer ones grow by doubling.
constexpr std::size_t kUsualTrack = 16;
constexpr std::size_t kFewestSlots = 64;

bool before(const std::pair<LandmarkId, int>& entry, LandmarkId id) { return entry.first < id; }

}  // namespace

int State::toPose(FrameId frame) const {
  const auto at = std::lower_bound(poses.begin(), poses.end(), frame,
                                   [](const PoseBlock& pose, FrameId value) { return pose.frame < value; });
  return at != poses.end() && at->frame == frame ? static_cast<int>(at - poses.begin()) : -1;
}

int State::findSlot(LandmarkId landmark) const {
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
    landmarks[slot].seen.reserve(kUsualTrack);
    free_.push_back(static_cast<int>(slot));
  }
}

int State::add(LandmarkId landmark) {
  if (free_.empty()) reserve(std::max(kFewestSlots, 2 * landmarks.size()));
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

void archive(urban_nav_core::Archive& archive, ProcessInput& u) { archive(u.T_from_to, u.information, u.T_from_start); }

void archive(urban_nav_core::Archive& archive, Anchor& anchor) { archive(anchor.R_odom_anchor, anchor.t_odom_anchor); }

void archive(urban_nav_core::Archive& archive, PoseBlock& pose) {
  archive(pose.frame, pose.estimate, pose.linearised, pose.u, pose.u_solved);
  for (PoseMatrices* at : {&pose.at_estimate, &pose.at_linearised}) archive(at->R_camera_odom, at->t_odom_camera);
}

void archive(urban_nav_core::Archive& archive, Measurement& measurement) {
  archive(measurement.step, measurement.z, measurement.information, measurement.template_drift_covariance,
          measurement.sigma_px);
  archive(measurement.inflation, measurement.weight, measurement.solved);
}

void archive(urban_nav_core::Archive& archive, LandmarkBlock& landmark) {
  archive(landmark.id, landmark.anchor, landmark.estimate, landmark.linearised, landmark.prior,
          landmark.template_drift_covariance);
  archive(landmark.used, landmark.known, landmark.followed, landmark.seen);
}

void State::archive(urban_nav_core::Archive& archive) {
  archive(poses, first_step, landmarks, disparity_offset, slots_, free_);
  if (archive.isReading()) check(archive);
}

// Indices are used without checks afterwards.
void State::check(const urban_nav_core::Archive& archive) const {
  archive.require(slots_.size() + free_.size() == landmarks.size(), "missing landmark slots");
  for (std::size_t j = 1; j < poses.size(); ++j)
    archive.require(poses[j].frame > poses[j - 1].frame, "frames are not increasing");
  std::vector<bool> taken(landmarks.size(), false);
  const auto take = [&](int slot, bool used) {
    const auto at = static_cast<std::size_t>(slot);
    archive.require(slot >= 0 && at < landmarks.size() && !taken[at] && landmarks[at].used == used,
                    "invalid or duplicate landmark slot");
    taken[at] = true;
  };
  for (const int slot : free_) take(slot, false);
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const auto& [id, slot] = slots_[i];
    take(slot, true);
    archive.require(landmarks[static_cast<std::size_t>(slot)].id == id && (i == 0 || slots_[i - 1].first < id),
                    "landmark ids are not increasing");
  }
  for (const LandmarkBlock& landmark : landmarks) {
    archive.require(landmark.used || landmark.seen.empty(), "free slot with measurements");
    std::int64_t last = first_step - 1;
    for (const Measurement& measurement : landmark.seen) {
      archive.require(measurement.step > last && measurement.step <= newestStep(), "measurement without a pose");
      last = measurement.step;
    }
  }
}

}  // namespace swf_vo
