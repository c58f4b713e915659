// SPDX-License-Identifier: BSD-3-Clause
#include "motion/propagation.hpp"

#include <utility>

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace swf_vo {

using urban_nav_core::compose;
using urban_nav_core::Matrix6d;
using urban_nav_core::MotionInput;
using urban_nav_core::MotionSource;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::secondsBetween;
using urban_nav_core::StampNs;

namespace {

// Without frames for this time, the poses that follow are propagated from the newest one, so that each is computed from
// a bounded number of measurements, s.
constexpr double kLongestSpan = 1.0;

PoseWithCovariance composed(const PoseWithCovariance& T_odom_from, const ProcessInput& u) {
  PoseWithCovariance step;
  step.pose = u.T_from_to;
  step.covariance = urban_nav_core::inverseByLu<6>(u.information);
  return compose(T_odom_from, step);
}

}  // namespace

Propagation::Implementation::Implementation(const Parameters& parameters, const Pose& T_base_camera,
                                            Prediction prediction, urban_nav_core::MotionSensors sensors, StampNs stamp,
                                            const PoseWithCovariance& newest, const Velocity& velocity)
    : acceleration_(parameters.acceleration),
      angular_acceleration_(parameters.angular_acceleration),
      T_base_camera_(T_base_camera),
      prediction_(std::move(prediction)),
      sensors_(std::move(sensors)),
      frame_stamp_(stamp),
      anchor_(stamp),
      T_odom_camera_(newest),
      velocity_(velocity) {}

ProcessInput Propagation::Implementation::step(StampNs to) const {
  const ProcessInput u = prediction_.step(secondsBetween(anchor_, to), {});
  const std::optional<ProcessInput> reckoned =
      predictCamera(sensors_, anchor_, to, T_odom_camera_.pose, T_base_camera_);
  return reckoned ? fuse(u, reckoned->T_from_to, reckoned->information) : u;
}

Velocity Propagation::Implementation::velocity(StampNs to) const {
  const double seconds = secondsBetween(frame_stamp_, to);
  const double speed = acceleration_ * seconds, turn = angular_acceleration_ * seconds;
  Velocity steady = velocity_;
  steady.covariance.diagonal().head<3>().array() += speed * speed;
  steady.covariance.diagonal().tail<3>().array() += turn * turn;
  return sensors_.velocity(steady);
}

std::optional<PropagatedPose> Propagation::Implementation::add(const MotionInput& input) {
  if (input.to <= frame_stamp_) return std::nullopt;  // the filter received it with the frame
  sensors_.append(input);
  if (input.source != MotionSource::Gyroscope || !sensors_.followsGyroscope()) return std::nullopt;
  const StampNs to = sensors_.newestRate();
  if (to <= anchor_) return std::nullopt;
  const ProcessInput u = step(to);
  const PoseWithCovariance T_odom_camera = composed(T_odom_camera_, u);
  PoseWithCovariance T_camera_base;
  T_camera_base.pose = T_base_camera_.inverse();
  T_camera_base.covariance.setZero();
  PropagatedPose result;
  result.stamp = to;
  result.T_odom_base = compose(T_odom_camera, T_camera_base);
  result.velocity = velocity(to);
  if (secondsBetween(anchor_, to) > kLongestSpan) moveAnchor(to, u, T_odom_camera);
  return result;
}

void Propagation::Implementation::moveAnchor(StampNs to, const ProcessInput& u,
                                             const PoseWithCovariance& T_odom_camera) {
  const double seconds = secondsBetween(anchor_, to);
  prediction_.learn(u.T_from_to, seconds, false, true);
  sensors_.continueUnmeasured(to, seconds);
  T_odom_camera_ = T_odom_camera;
  anchor_ = to;
}

Propagation::Propagation(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
Propagation::~Propagation() = default;
Propagation::Propagation(Propagation&&) noexcept = default;
Propagation& Propagation::operator=(Propagation&&) noexcept = default;

std::optional<PropagatedPose> Propagation::add(const MotionInput& input) { return implementation_->add(input); }

}  // namespace swf_vo
