// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/motion/up_direction.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_core {

namespace {

constexpr double kUpGravity = 9.81;          // m/s^2
constexpr double kFade = 20.0;               // s
constexpr double kLeastSeconds = 1.0;        // of forces, for an estimate
constexpr double kVelocitySigma = 0.2;       // m/s: of the change of the velocity, from steps of the reference
constexpr double kAccelerometerTilt = 0.01;  // rad: by the bias and by rotation about the lever arm
// Forces of a working accelerometer in driving vehicles, as a share of gravity: others are vibration or faults.
constexpr double kLeastUpForce = 0.5, kMostUpForce = 1.5;
constexpr std::size_t kMostForces = 4000;

}  // namespace

void UpDirection::add(const MotionInput& input) {
  const double size = input.specific_force.norm() / kUpGravity;
  if (!(size > kLeastUpForce && size < kMostUpForce)) return;
  if (!forces_.empty() && input.to <= forces_.back().stamp) return;
  forces_.push_back({input.to, input.specific_force});
  if (forces_.size() > kMostForces) forces_.erase(forces_.begin(), forces_.begin() + kMostForces / 2);
}

void UpDirection::addStep(StampNs from, StampNs to, const Pose& T_from_to, const Quaterniond& q_odom_to, bool follows) {
  const auto begin =
      std::partition_point(forces_.begin(), forces_.end(), [&](const Force& force) { return force.stamp <= from; });
  const auto end = std::partition_point(begin, forces_.end(), [&](const Force& force) { return force.stamp <= to; });
  Vector3d sum = Vector3d::Zero();
  for (auto force = begin; force != end; ++force) sum += force->force;
  const auto count = static_cast<double>(end - begin);
  forces_.erase(forces_.begin(), end);
  const double seconds = secondsBetween(from, to);
  if (!(seconds > 0.0)) return;
  const Quaterniond q_odom_from = q_odom_to * T_from_to.q().conjugate();
  const Quaterniond q_odom_middle = q_odom_from.slerp(0.5, q_odom_to);
  const Vector3d velocity = q_odom_from * T_from_to.t() / seconds, before = velocity_;
  velocity_ = velocity;
  if (!follows || count == 0.0) return;
  const double fade = std::exp(-seconds / kFade);
  impulse_ = fade * impulse_ + q_odom_middle * sum * (seconds / count) - (velocity - before);
  seconds_ = fade * seconds_ + seconds;
}

std::optional<UpDirection::Estimate> UpDirection::estimate() const {
  if (seconds_ < kLeastSeconds || !(impulse_.norm() > kLeastUpForce * kUpGravity * seconds_)) return std::nullopt;
  return Estimate{impulse_.normalized(), std::hypot(kAccelerometerTilt, kVelocitySigma / (kUpGravity * seconds_))};
}

void UpDirection::archive(Archive& archive) {
  archive(forces_, impulse_, velocity_, seconds_);
  archive.require(seconds_ >= 0.0, "a negative duration");
}

}  // namespace urban_nav_core
