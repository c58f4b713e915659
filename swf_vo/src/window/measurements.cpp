// SPDX-License-Identifier: BSD-3-Clause
#include "window/measurements.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/dense.hpp"

namespace swf_vo::measurements {

using Eigen::Vector3d;
using urban_nav_core::Pose;

namespace {

// Limits of a diverged estimate: bearings over 84 deg from the axis at the first observation, or distances below a
// tenth of a millimetre.
constexpr double kAbsurdBearing = 10.0;
constexpr double kAbsurdInverseDepth = 1e4;

bool isSane(const Vector3d& theta) {
  return std::abs(theta.x()) < kAbsurdBearing && std::abs(theta.y()) < kAbsurdBearing &&
         std::abs(theta.z()) < kAbsurdInverseDepth;
}

bool hasFullRank(Eigen::Matrix3d information) {
  const Vector3d diagonal = information.diagonal();
  if (!urban_nav_core::choleskyInPlace(information)) return false;
  for (int i = 0; i < 3; ++i)
    if (!(information(i, i) * information(i, i) > 1e-9 * diagonal[i])) return false;
  return true;
}

// Returns a rotation that maps z to the direction.
Eigen::Matrix3d lookingAlong(const Vector3d& direction) {
  Eigen::Matrix3d R;
  const Vector3d z = direction.normalized();
  const Vector3d x = (std::abs(z.x()) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY()).cross(z).normalized();
  R << x, z.cross(x), z;
  return R;
}

}  // namespace

Vector3d withoutOffset(const State& state, const Vector3d& z) { return {z.x(), z.y(), z.z() + state.disparity_offset}; }

bool fixLandmark(State& state, const MapPoint& point) {
  if (state.findSlot(point.landmark) >= 0 || !point.p_odom.allFinite()) return false;
  LandmarkBlock& landmark = state.landmarks[static_cast<std::size_t>(state.add(point.landmark))];
  landmark.known = true;
  // Anchor at the origin with its z axis towards the point.
  landmark.anchor.R_odom_anchor = lookingAlong(point.p_odom.head<3>());
  landmark.anchor.t_odom_anchor.setZero();
  landmark.estimate = landmark.linearised = Vector3d(0.0, 0.0, point.p_odom.w() / point.p_odom.head<3>().norm());
  return landmark.estimate.allFinite();
}

void place(State& state, const SensorModel& sensor, int slot, const Measurement& first) {
  LandmarkBlock& landmark = state.landmarks[static_cast<std::size_t>(slot)];
  const Pose& T_odom_camera = state.poses[static_cast<std::size_t>(first.step - state.first_step)].estimate;
  landmark.anchor.R_odom_anchor = T_odom_camera.R();
  landmark.anchor.t_odom_anchor = T_odom_camera.t();
  landmark.estimate = landmark.linearised = sensor.invert(withoutOffset(state, first.z));
}

bool observe(State& state, const SensorModel& sensor, const Observation& observation) {
  const int pose = state.toPose(observation.frame);
  if (pose < 0 || !observation.z.allFinite() || !observation.information.allFinite()) return false;
  Measurement measurement;
  measurement.step = state.first_step + pose;
  measurement.z = observation.z;
  // Asymmetry would act as positive or negative information in unmeasured directions: at 1e-8 of a pixel's it exceeds
  // the information of a second of prediction.
  measurement.information = 0.5 * (observation.information + observation.information.transpose());
  measurement.sigma_px = observation.sigma_px;
  measurement.inflation = observation.inflation;
  measurement.template_drift_covariance = sensor.bearing(observation.template_drift_covariance);
  int slot = state.findSlot(observation.landmark);
  if (slot < 0) {
    if (!hasFullRank(observation.information) || !isSane(sensor.invert(withoutOffset(state, observation.z))))
      return false;
    slot = state.add(observation.landmark);
    place(state, sensor, slot, measurement);
  }
  LandmarkBlock& landmark = state.landmarks[static_cast<std::size_t>(slot)];
  auto at = landmark.seen.end();
  while (at != landmark.seen.begin() && std::prev(at)->step > measurement.step) --at;
  if (at != landmark.seen.begin() && std::prev(at)->step == measurement.step) return false;
  landmark.seen.insert(at, measurement);
  return true;
}

bool withdraw(State& state, LandmarkId id, FrameId frame) {
  const int slot = state.findSlot(id);
  const int pose = state.toPose(frame);
  if (slot < 0 || pose < 0) return false;
  LandmarkBlock& landmark = state.landmarks[static_cast<std::size_t>(slot)];
  const std::int64_t step = state.first_step + pose;
  const auto at =
      std::find_if(landmark.seen.begin(), landmark.seen.end(), [&](const Measurement& m) { return m.step == step; });
  if (at == landmark.seen.end()) return false;
  landmark.seen.erase(at);
  // Without measurements the landmark is removed; the next one initialises it again.
  if (landmark.seen.empty() && landmark.prior < 0 && !landmark.known) state.remove(slot);
  return true;
}

void replace(State& state, const SensorModel& sensor, FrameId frame, const std::vector<Observation>& observations) {
  const int pose = state.toPose(frame);
  if (pose < 0) return;
  const std::int64_t step = state.first_step + pose;
  for (LandmarkBlock& landmark : state.landmarks) {
    if (!landmark.used) continue;
    const auto same = [&](const Measurement& measurement) { return measurement.step == step; };
    landmark.seen.erase(std::remove_if(landmark.seen.begin(), landmark.seen.end(), same), landmark.seen.end());
  }
  for (const Observation& observation : observations) observe(state, sensor, observation);
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot) {
    const LandmarkBlock& landmark = state.landmarks[slot];
    if (landmark.used && landmark.seen.empty() && landmark.prior < 0 && !landmark.known)
      state.remove(static_cast<int>(slot));
  }
}

bool undoAbsurd(State& state) {
  bool any = false;
  for (std::size_t slot = 0; slot < state.landmarks.size(); ++slot) {
    LandmarkBlock& landmark = state.landmarks[slot];
    if (!landmark.used || landmark.known || isSane(landmark.estimate)) continue;
    landmark.estimate = landmark.linearised;
    any = true;
  }
  return any;
}

}  // namespace swf_vo::measurements
