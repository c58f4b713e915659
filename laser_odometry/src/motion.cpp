// SPDX-License-Identifier: BSD-3-Clause
#include "motion.hpp"

#include <algorithm>

namespace laser_odometry {
namespace {

// Typical limits of a vehicle, while the motion is unknown.
constexpr double kUsualSpeed = 15.0;  // m/s
constexpr double kUsualRate = 1.0;    // rad/s

}  // namespace

Pose MotionModel::predict(double seconds) const { return urban_nav_core::expSe3(twist_ * seconds); }

Matrix6d MotionModel::predictionCovariance(double seconds) const {
  const double since = unobserved_s_ + seconds;
  const double speed = known_ ? std::min(kUsualSpeed, parameters_.acceleration * since) : kUsualSpeed;
  const double rate = known_ ? std::min(kUsualRate, parameters_.angular_acceleration * since) : kUsualRate;
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(speed * seconds), Eigen::Vector3d::Constant(rate * seconds);
  return sigma.cwiseAbs2().asDiagonal();
}

Vector6d MotionModel::sweepTwist(const Pose& T_from_to, double seconds) const {
  const Vector6d mean = urban_nav_core::logSe3(T_from_to) / seconds;
  return has_step_ ? Vector6d(mean + 0.5 * (mean - step_twist_)) : mean;
}

void MotionModel::update(const Pose& T_from_to, double seconds, bool observed) {
  twist_ = sweepTwist(T_from_to, seconds);
  step_twist_ = urban_nav_core::logSe3(T_from_to) / seconds;
  has_step_ = true;
  known_ = known_ || observed;
  unobserved_s_ = observed ? 0.0 : unobserved_s_ + seconds;
}

void MotionModel::archive(urban_nav_core::Archive& archive) {
  archive(known_, has_step_, step_twist_, twist_, unobserved_s_);
  archive.require(unobserved_s_ >= 0.0, "negative time");
}

}  // namespace laser_odometry
