// SPDX-License-Identifier: BSD-3-Clause
#include "window/landmark_scores.hpp"

#include <algorithm>
#include <cmath>

#include "window/reserve_with_headroom.hpp"

namespace swf_vo {

using urban_nav_core::Pose;

void LandmarkScores::clear() {
  view_change_ = 0.0;
  scores_.clear();
  sandwich_ = DriftSandwich();
  of_offset_ = OffsetSandwich();
}

void LandmarkScores::add(std::size_t slot, const LandmarkBlock& landmark, const PoseBlock& pose,
                         const SensorTerm& term) {
  if (slot >= scores_.size()) scores_.resize(slot + 1);
  scores_[slot].add(landmark, pose, view_change_, term);
}

void LandmarkScores::age(std::size_t slot, const Eigen::Matrix2d& covariance) {
  if (slot < scores_.size()) scores_[slot].age(covariance);
}

void LandmarkScores::end(const std::vector<int>& slots, const Pose& T_odom_camera) {
  for (const int slot : slots) {
    const auto at = static_cast<std::size_t>(slot);
    if (at >= scores_.size() || !scores_[at].isUsed()) continue;
    const DriftScore score = scores_[at].evaluate(T_odom_camera);
    sandwich_.add(score);
    of_offset_.add(score);
    scores_[at].clear();
  }
}

void LandmarkScores::advance(const State& state, const Pose& T_from_to) {
  reserveWithHeadroom(inverse_depths_, state.landmarks.size());
  inverse_depths_.clear();
  for (const LandmarkBlock& landmark : state.landmarks)
    if (landmark.used && !landmark.known) inverse_depths_.push_back(landmark.estimate.z());
  double usual = 0.0;
  if (!inverse_depths_.empty()) {
    const auto middle = inverse_depths_.begin() + static_cast<std::ptrdiff_t>(inverse_depths_.size() / 2);
    std::nth_element(inverse_depths_.begin(), middle, inverse_depths_.end());
    usual = std::max(0.0, *middle);
  }
  const double change = usual * T_from_to.t().norm() + angleBetween(Pose(), T_from_to);
  view_change_ += change;
  sandwich_.advance(change);
  of_offset_.advance(change);
}

void LandmarkScores::archive(urban_nav_core::Archive& archive) {
  archive(view_change_, scores_, sandwich_, of_offset_);
}

}  // namespace swf_vo
