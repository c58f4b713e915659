// SPDX-License-Identifier: BSD-3-Clause
#include "motion.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/archive_types.hpp"

namespace laser_odometry {
namespace {

// Typical limits of a vehicle, while its motion is unknown.
constexpr double kUsualSpeed = 15.0;  // m/s
constexpr double kUsualRate = 1.0;    // rad/s
constexpr double kLeastSpeed = 1.4;   // m/s: walking pace, the least limit once the motion is known
// Correlation times of accelerations, s (model of Singer, IEEE Trans. AES 6, 1970). A constant acceleration of 4 s,
// with which the urban driving cycle starts (1.04 m/s^2 for 4 s: UN Regulation 83, elementary urban cycle), has a
// correlation time of 2 s. The yaw rate of a vehicle follows its steering after about 0.2 s (response time as in
// ISO 7401).
constexpr double kAccelerationTime = 2.0;
constexpr double kTurnAccelerationTime = 0.2;
constexpr double kSameDirection = 0.05;  // rad: free directions vary by noise from sweep to sweep
// Variance of twist_ over that of the mean velocity of a step: 1.5 of this step and -0.5 of the previous one.
constexpr double kExtrapolated = 1.5 * 1.5 + 0.5 * 0.5;

/// Returns the variance of the displacement after a time by accelerations of variance 1 with a correlation time.
double displacementVariance(double seconds, double correlation_s) {
  const double s = seconds / correlation_s, scale = correlation_s * correlation_s;
  if (s < 1e-2) return 0.25 * std::pow(seconds, 4);  // the terms below cancel
  return scale * scale * (2.0 / 3.0 * s * s * s - s * s + 2.0 - 2.0 * (1.0 + s) * std::exp(-s));
}

/// Returns the variance of the velocity after a time by accelerations of variance 1 with a correlation time.
double velocityVariance(double seconds, double correlation_s) {
  const double s = seconds / correlation_s;
  if (s < 1e-4) return seconds * seconds;
  return 2.0 * correlation_s * correlation_s * (s - 1.0 + std::exp(-s));
}

Matrix6d isotropic(double translation, double rotation) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(translation), Eigen::Vector3d::Constant(rotation);
  return variances.asDiagonal();
}

}  // namespace

Matrix6d projectorOnto(const std::vector<Vector6d>& directions) {
  Matrix6d P = Matrix6d::Zero();
  for (const Vector6d& direction : directions) {
    const Vector6d unit = direction.normalized();
    Vector6d rest = unit - P * unit;
    if (!(rest.norm() > kSameDirection)) continue;
    rest.normalize();
    rest = (rest - P * rest).normalized();
    P += rest * rest.transpose();
  }
  return P;
}

Pose MotionModel::predict(double seconds) const { return urban_nav_core::expSe3(twist_ * seconds); }

Matrix6d MotionModel::predictionCovariance(double seconds) const {
  const double before = unobserved_s_, after = unobserved_s_ + seconds, squares = after * after - before * before;
  if (!known_) return squares * isotropic(kUsualSpeed * kUsualSpeed, kUsualRate * kUsualRate);
  const auto growth = [&](double acceleration, double correlation_s, double limit) {
    const double grown = displacementVariance(after, correlation_s) - displacementVariance(before, correlation_s);
    return std::min(limit * limit * squares, acceleration * acceleration * grown);
  };
  return squares * twist_covariance_ +
         isotropic(growth(parameters_.acceleration, kAccelerationTime, std::max(kLeastSpeed, fastest_)),
                   growth(parameters_.angular_acceleration, kTurnAccelerationTime, kUsualRate));
}

Matrix6d MotionModel::stepCovariance(double seconds) const {
  const double square = seconds * seconds;
  if (!known_) return square * isotropic(kUsualSpeed * kUsualSpeed, kUsualRate * kUsualRate);
  const auto variance = [&](double acceleration, double correlation_s, double limit) {
    const double grown =
        velocityVariance(unobserved_s_, correlation_s) * square + displacementVariance(seconds, correlation_s);
    return std::min(limit * limit * square, acceleration * acceleration * grown);
  };
  return square * twist_covariance_ +
         isotropic(variance(parameters_.acceleration, kAccelerationTime, std::max(kLeastSpeed, fastest_)),
                   variance(parameters_.angular_acceleration, kTurnAccelerationTime, kUsualRate));
}

Vector6d MotionModel::sweepTwist(const Pose& T_from_to, double seconds) const {
  const Vector6d mean = urban_nav_core::logSe3(T_from_to) / seconds;
  const Vector6d change = mean - step_twist_;
  const Vector6d measured = has_step_ ? Vector6d(mean + 0.5 * (change - unmeasured_ * change)) : mean;
  return known_ ? Vector6d(measured + projectorOnto(free_) * (twist_ - measured)) : measured;
}

void MotionModel::update(const Pose& T_from_to, double seconds, const StepEvidence& evidence) {
  std::vector<Vector6d> unmeasured = evidence.free;
  if (known_) unmeasured.insert(unmeasured.end(), free_.begin(), free_.end());
  const Matrix6d F = projectorOnto(unmeasured), rest = Matrix6d::Identity() - F;
  const Vector6d mean = urban_nav_core::logSe3(T_from_to) / seconds, measured = sweepTwist(T_from_to, seconds);
  twist_ = known_ ? Vector6d(rest * measured + F * twist_) : measured;
  step_twist_ = known_ ? Vector6d(rest * mean + F * twist_) : mean;
  Vector6d change;  // velocity within a step, as in deskewing
  change << Eigen::Vector3d::Constant(parameters_.acceleration * seconds),
      Eigen::Vector3d::Constant(parameters_.angular_acceleration * seconds);
  Matrix6d of_step = kExtrapolated / (seconds * seconds) * evidence.covariance;
  of_step.diagonal() += change.cwiseAbs2();
  twist_covariance_ = rest * of_step * rest.transpose() + F * twist_covariance_ * F.transpose();
  twist_covariance_ = (0.5 * (twist_covariance_ + twist_covariance_.transpose())).eval();
  if (unmeasured.empty()) fastest_ = std::max(fastest_, mean.head<3>().norm());
  has_step_ = true;
  known_ = known_ || evidence.free.empty();
  free_ = evidence.free;
  unmeasured_ = F;
  unobserved_s_ = unmeasured.empty() ? 0.0 : unobserved_s_ + seconds;
}

void MotionModel::archive(urban_nav_core::Archive& archive) {
  archive(known_, has_step_, step_twist_, twist_, twist_covariance_, free_, unmeasured_, fastest_, unobserved_s_);
  archive.require(unobserved_s_ >= 0.0 && fastest_ >= 0.0, "negative time or speed");
}

}  // namespace laser_odometry
