// SPDX-License-Identifier: BSD-3-Clause
#include "prediction.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace swf_vo {

using urban_nav_core::adjoint;
using urban_nav_core::boxMinus;
using urban_nav_core::boxPlus;
using urban_nav_core::expSe3;
using urban_nav_core::logSe3;
using urban_nav_core::Matrix6d;
using urban_nav_core::MotionInput;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;

namespace {

// Consecutive usable images without matches at the predicted positions after which the velocity is dropped.
constexpr int kPatience = 3;
// Gap after which the velocity is not informative: the motion is unknown.
constexpr double kVelocityHolds = 5.0;  // s

Matrix6d fromSigmas(double translation, double rotation) {
  Vector6d diagonal;
  diagonal << Eigen::Vector3d::Constant(1.0 / (translation * translation)),
      Eigen::Vector3d::Constant(1.0 / (rotation * rotation));
  return diagonal.asDiagonal();
}

// Transforms information from the tangent of base_link's motion to that of the camera; both are T_from_to, (rho, phi)
// in `from`.
Matrix6d toCamera(const Matrix6d& information_base, const Pose& T_base_camera) {
  // d(camera) = A d(base), hence information_camera = A^-T information_base A^-1, with A^-1 = adjoint(T_base_camera).
  const Matrix6d back = adjoint(T_base_camera);
  return back.transpose() * information_base * back;
}

// Successive inputs composed to one motion. Their covariances add up; for n inputs of similar information the
// information is the mean over n, which is valid for singular ones too.
struct Measured {
  int count = 0;
  double seconds = 0.0;
  Pose T_from_to;
  Matrix6d information = Matrix6d::Zero();
};

Measured together(const std::vector<MotionInput>& inputs) {
  Measured sum;
  for (const MotionInput& input : inputs) {
    const double span = urban_nav_core::secondsBetween(input.from, input.to);
    if (input.source != urban_nav_core::MotionSource::Given) continue;
    if (!(span > 0.0) || !input.T_from_to.isFinite() || !input.information.allFinite()) continue;
    ++sum.count;
    sum.seconds += span;
    sum.T_from_to = sum.T_from_to * input.T_from_to;
    sum.information += input.information;
  }
  if (sum.count > 0) sum.information /= static_cast<double>(sum.count) * sum.count;
  return sum;
}

}  // namespace

ProcessInput fuse(ProcessInput u, const Pose& T_from_to, const Matrix6d& information) {
  // Fusion of two measurements of one step in the tangent at the prediction.
  const Vector6d offset = boxMinus(T_from_to, u.T_from_to);
  const Matrix6d sum = u.information + information;
  u.T_from_to = boxPlus(u.T_from_to, urban_nav_core::solveByLdlt<6, 1>(sum, information * offset));
  u.information = sum;
  return u;
}

Prediction::Prediction(const Parameters& parameters, const Pose& T_base_camera)
    : T_base_camera_(T_base_camera),
      acceleration_(parameters.acceleration),
      angular_acceleration_(parameters.angular_acceleration),
      velocity_(Vector6d::Zero()) {}

ProcessInput Prediction::step(double seconds, const std::vector<MotionInput>& inputs) const {
  ProcessInput u;
  const double steps = 1.0 + unmeasured_;
  const bool known = known_ && seconds < kVelocityHolds;
  u.T_from_to = known ? expSe3(fadedVelocity() * seconds) : Pose();
  // Sigma is limited to that of an unknown velocity; for m steps at one unknown velocity it is m times that of one.
  const double speed = kUnknownSpeed * std::sqrt(2.0 * steps - 1.0) * seconds,
               angular_speed = kUnknownAngularSpeed * std::sqrt(2.0 * steps - 1.0) * seconds;
  const double drift = steps * seconds * seconds;
  u.information =
      known ? fromSigmas(std::min(acceleration_ * drift, speed), std::min(angular_acceleration_ * drift, angular_speed))
            : fromSigmas(kUnknownSpeed * seconds, kUnknownAngularSpeed * seconds);
  const Measured measured = together(inputs);
  if (measured.count == 0) return u;
  const Pose motion = expSe3(logSe3(measured.T_from_to) * (seconds / measured.seconds));
  const Pose camera = T_base_camera_.inverse() * motion * T_base_camera_;
  const Matrix6d information = toCamera(measured.information * (measured.seconds / seconds), T_base_camera_);
  return fuse(u, camera, information);
}

void Prediction::learn(const Pose& T_last_camera, double seconds, bool measured, bool blind, bool smoothed) {
  const bool reckoned = unmeasured_ > 0 && !smoothed;
  unmeasured_ = measured ? 0 : unmeasured_ + 1;
  if (!measured && !blind && unmeasured_ >= kPatience) known_ = false;
  if (!measured || !(seconds > 0.0) || (reckoned && known_)) return;
  const Vector6d velocity = logSe3(T_last_camera) / seconds;
  if (known_ && !reckoned) {
    translation_.see(velocity_.head<3>(), velocity.head<3>());
    rotation_.see(velocity_.tail<3>(), velocity.tail<3>());
  }
  velocity_ = velocity;
  known_ = true;
}

void Prediction::Persistence::see(const Vector3d& before, const Vector3d& now) {
  constexpr double kKept = 0.9;
  product = kKept * product + before.dot(now);
  square = kKept * square + 0.5 * (before.squaredNorm() + now.squaredNorm());
}

double Prediction::Persistence::correlation() const {
  return square > 0.0 ? std::clamp(product / square, 0.0, 1.0) : 1.0;
}

Vector6d Prediction::fadedVelocity() const {
  Vector6d velocity = velocity_;
  velocity.head<3>() *= std::pow(translation_.correlation(), unmeasured_);
  velocity.tail<3>() *= std::pow(rotation_.correlation(), unmeasured_);
  return velocity;
}

void Prediction::archive(urban_nav_core::Archive& archive) {
  archive(velocity_, known_, unmeasured_, translation_, rotation_);
}

}  // namespace swf_vo
