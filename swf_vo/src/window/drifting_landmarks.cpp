// SPDX-License-Identifier: BSD-3-Clause
#include "window/drifting_landmarks.hpp"

#include <cmath>

#include "robust_threshold.hpp"
#include "window/measurements.hpp"
#include "window/reserve_with_headroom.hpp"

namespace swf_vo {

using Eigen::Vector3d;

namespace {

constexpr int kFewestCoordinates = 12;      // four frames: with fewer, a landmark's position absorbs its errors
constexpr std::size_t kFewestForTest = 16;  // landmarks required for the typical residual

}  // namespace

bool DriftingLandmarks::score(const State& state, const SensorModel& sensor, const LandmarkBlock& landmark) {
  double sum = 0.0;
  int coordinates = 0;
  Vector3d z;
  for (const Measurement& measurement : landmark.seen) {
    const PoseBlock& pose = state.poses[static_cast<std::size_t>(measurement.step - state.first_step)];
    if (!(measurement.sigma_px > 0.0) || !sensor.predict(landmark.anchor, landmark.estimate, pose.at_estimate, z))
      continue;
    const Vector3d r = (measurements::withoutOffset(state, measurement.z) - z) / measurement.sigma_px;
    for (int c = 0; c < 3; ++c) {
      if (!(measurement.information(c, c) > 0.0)) continue;
      sum += r[c] * r[c];
      ++coordinates;
    }
  }
  if (coordinates < kFewestCoordinates) return false;
  scores_.push_back({landmark.id, std::sqrt(sum / coordinates)});
  return true;
}

const std::vector<LandmarkId>& DriftingLandmarks::find(const State& state, const SensorModel& sensor) {
  reserveWithHeadroom(scores_, state.landmarks.size());
  reserveWithHeadroom(sorted_, state.landmarks.size());
  reserveWithHeadroom(drifting_, state.landmarks.size());
  scores_.clear();
  sorted_.clear();
  drifting_.clear();
  for (const LandmarkBlock& landmark : state.landmarks)
    if (landmark.used && !landmark.known && landmark.followed && score(state, sensor, landmark))
      sorted_.push_back(scores_.back().residual);
  if (scores_.size() < kFewestForTest) return drifting_;
  const double limit = robustThreshold(sorted_.begin(), sorted_.end());
  for (const Score& score : scores_)
    if (score.residual > limit) drifting_.push_back(score.landmark);
  return drifting_;
}

}  // namespace swf_vo
