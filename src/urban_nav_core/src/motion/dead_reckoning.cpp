// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/motion/dead_reckoning.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace urban_nav_core {

namespace {

// Lateral slip and vertical motion of wheels, m per square root of a metre: 2 % of a metre.
constexpr double kSlip = 0.02;
// Roll and pitch of a vehicle without measured rates, rad per square root of a second.
constexpr double kTilt = 0.05;
// Position of base_link relative to the wheels, by tyres and pitching of the body, m.
constexpr double kPlay = 2e-3;
// Change of the ground's slope per square root of a metre; height of bumps per metre.
constexpr double kSlopeWalk = 0.01, kBumps = 0.02;
// Slope of streets and paths, rad, and the least upward component of `odom`'s z axis for a slope to be defined.
constexpr double kStreetSlope = 0.03, kLeastUp = 0.7;
// Rate noise of the best sensors of this kind, rad/s/sqrt(Hz): lower limit of stated values.
constexpr double kLeastRateNoise = 2e-5;

/// Integrates position and rotation with covariance and with Jacobians by the states common to all steps.
class Integration {
 public:
  static constexpr int kShared = MotionStates::kSize + 2;  // and slope of the ground
  using Jacobian = Eigen::Matrix<double, 6, kShared>;

  Integration(const MotionEvidence& evidence, const Quaterniond& q_odom_base)
      : evidence_(evidence),
        R_base_odom_(q_odom_base.conjugate().toRotationMatrix()),
        normal_(R_base_odom_ * evidence.ground->normal()) {}

  /// Rotates by the gyroscope, between two times on the clock of the reference.
  Coverage turn(StampNs from, StampNs to) {
    const MotionStates& states = *evidence_.states;
    const TwistStream& stream = *evidence_.gyroscope;
    const double offset = states.mean[MotionStates::kImuOffset];
    return stream.cover(delayed(from, offset), delayed(to, offset), [&](const TwistSpan& span, double seconds) {
      const Vector3d rate = span.twist.tail<3>() - states.bias();
      if (!begun_) first_rate_ = rate;
      begun_ = true;
      last_rate_ = rate;
      const Matrix3d J = q_.toRotationMatrix() * leftJacobianSo3(rate * seconds);
      shared_.block<3, 3>(3, MotionStates::kBias) -= seconds * J;
      rotate(rate * seconds, evidence_.gyroscope_noise * rateDensity(stream, span) * seconds * Matrix3d::Identity());
    });
  }

  /// Rotates by the yaw of a wheel span, half of it before and half after the translation, about the base's z axis.
  void turnByWheels(const TwistSpan& span, double seconds) {
    const double scale = 1.0 + evidence_.states->mean[MotionStates::kTurnScale], turn = span.twist[5] / scale * seconds;
    shared_.block<3, 1>(3, MotionStates::kTurnScale) -= turn / scale * q_.toRotationMatrix().col(2);
    Vector3d variance = Vector3d::Constant(kTilt * kTilt * seconds);
    variance.z() = evidence_.wheel_noise * span.density[5] * seconds / (scale * scale);
    const Matrix3d R = q_.toRotationMatrix();
    rotate({0.0, 0.0, turn}, R * variance.asDiagonal() * R.transpose());
  }

  /// Translates along the ground at the speed of the wheels.
  void move(const TwistSpan& span, double seconds) {
    const double scale = 1.0 + evidence_.states->mean[MotionStates::kSpeedScale],
                 distance = span.twist[0] / scale * seconds;
    const Vector3d forward = q_.toRotationMatrix().col(0), level = forward - normal_ * normal_.dot(forward);
    const Vector3d along = level.norm() > 0.1 ? level.normalized() : forward;
    const Vector3d step = distance * along;
    // A rotation about the normal of the ground rotates the step; other rotations leave it on the ground.
    Matrix6d A = Matrix6d::Identity();
    A.topRightCorner<3, 3>() = normal_.cross(step) * normal_.transpose();
    covariance_ = (A * covariance_ * A.transpose()).eval();
    shared_ = (A * shared_).eval();
    shared_.block<3, 1>(0, MotionStates::kSpeedScale) -= step / scale;
    const Vector3d in_odom = R_base_odom_.transpose() * step;
    shared_.block<3, 2>(0, MotionStates::kSize) += normal_ * in_odom.head<2>().transpose();
    const double across = kSlip * kSlip * std::abs(distance);
    covariance_.topLeftCorner<3, 3>() +=
        across * (Matrix3d::Identity() - along * along.transpose()) +
        evidence_.wheel_noise * span.density[0] * seconds / (scale * scale) * along * along.transpose();
    const Vector3d velocity = span.twist[0] / scale * along;
    if (!moved_) first_velocity_ = velocity;
    moved_ = true;
    last_velocity_ = velocity;
    t_ += step;
  }

  /// Adds the uncertainty of extrapolation over these times, s.
  void extrapolate(double gyroscope, double wheels) {
    const auto change = [](double walk, double seconds) { return walk * seconds * seconds * seconds / 3.0; };
    if (evidence_.gyroscope != nullptr)
      for (int i = 0; i < 3; ++i) covariance_(3 + i, 3 + i) += change(evidence_.gyroscope->walk()[3 + i], gyroscope);
    if (evidence_.wheels != nullptr) {
      covariance_(0, 0) += change(evidence_.wheels->walk()[0], wheels);
      covariance_.topLeftCorner<3, 3>() += kPlay * kPlay * Matrix3d::Identity();
    }
  }

  Reckoned finish(double seconds) {
    if (begun_) shared_.block<3, 1>(3, MotionStates::kImuOffset) = q_.toRotationMatrix() * last_rate_ - first_rate_;
    if (moved_) shared_.block<3, 1>(0, MotionStates::kWheelOffset) = last_velocity_ - first_velocity_;
    Eigen::Matrix<double, kShared, kShared> P = Eigen::Matrix<double, kShared, kShared>::Zero();
    P.topLeftCorner<MotionStates::kSize, MotionStates::kSize>() = evidence_.states->covariance;
    P.bottomRightCorner<2, 2>() = evidence_.ground->covariance;
    Reckoned result;
    result.T_from_to = Pose(q_, t_);
    result.covariance_alone = total(P);
    // An error common to all steps grows linearly with time, its variance with the square: this is its increment.
    // Delays affect the ends of the chain only.
    const auto share = [&](double unmeasured) { return std::sqrt((2.0 * unmeasured + seconds) / seconds); };
    const double turn = share(evidence_.turn_unmeasured), forward = share(evidence_.forward_unmeasured);
    for (int i = 0; i < kShared; ++i) {
      if (i == MotionStates::kImuOffset || i == MotionStates::kWheelOffset) continue;
      const bool turns = i < MotionStates::kImuOffset || i == MotionStates::kTurnScale;
      shared_.col(i) *= turns ? turn : forward;
    }
    result.covariance = total(P);
    result.has_gyroscope = evidence_.gyroscope != nullptr;
    result.has_translation = evidence_.wheels != nullptr;
    return result;
  }

 private:
  Matrix6d total(const Eigen::Matrix<double, kShared, kShared>& P) const {
    const Matrix6d sum = covariance_ + shared_ * P * shared_.transpose();
    return 0.5 * (sum + sum.transpose());
  }

  void rotate(const Vector3d& turn, const Matrix3d& variance) {
    q_ = (q_ * expSo3(turn)).normalized();
    covariance_.bottomRightCorner<3, 3>() += variance;
  }

  const MotionEvidence& evidence_;
  Matrix3d R_base_odom_;
  Vector3d normal_;  // normal of the ground, in base_link at `from`
  Quaterniond q_ = Quaterniond::Identity();
  Vector3d t_ = Vector3d::Zero();
  Matrix6d covariance_ = Matrix6d::Zero();
  Jacobian shared_ = Jacobian::Zero();
  bool begun_ = false, moved_ = false;
  Vector3d first_rate_ = Vector3d::Zero(), last_rate_ = Vector3d::Zero();
  Vector3d first_velocity_ = Vector3d::Zero(), last_velocity_ = Vector3d::Zero();
};

StampNs toNs(double seconds) { return static_cast<StampNs>(std::llround(1e9 * seconds)); }

}  // namespace

void GroundSlope::learn(const Vector3d& step, double variance) {
  const Eigen::Vector2d step_in_plane = step.head<2>();
  const double length = step_in_plane.norm(), bumps = kBumps * length;
  covariance.diagonal().array() += kSlopeWalk * kSlopeWalk * length;
  const Eigen::Vector2d gain = covariance * step_in_plane;
  const double of_innovation = step_in_plane.dot(gain) + variance + bumps * bumps;
  mean += gain * ((step.z() - mean.dot(step_in_plane)) / of_innovation);
  covariance -= gain * gain.transpose() / of_innovation;
}

GroundSlope GroundSlope::levelled(const Vector3d& up, double sigma) const {
  if (!(up.z() > kLeastUp)) return *this;
  const Eigen::Vector2d level(-up.x() / up.z(), -up.y() / up.z());
  const Eigen::Matrix2d sum = covariance + (kStreetSlope * kStreetSlope + sigma * sigma) * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d gain = covariance * sum.inverse();
  GroundSlope fused = *this;
  fused.mean += gain * (level - mean);
  fused.covariance -= gain * covariance;
  fused.covariance = (0.5 * (fused.covariance + fused.covariance.transpose())).eval();
  return fused;
}

StampNs delayed(StampNs stamp, double offset_s) { return stamp + toNs(offset_s); }

double rateDensity(const TwistStream& gyroscope, const TwistSpan& span) {
  const double stated = span.density.tail<3>().mean();
  return std::max(stated > 0.0 ? stated : gyroscope.scatterDensity(), kLeastRateNoise * kLeastRateNoise);
}

std::optional<Reckoned> reckon(const MotionEvidence& evidence, StampNs from, StampNs to,
                               const Quaterniond& q_odom_base) {
  const double seconds = secondsBetween(from, to);
  const bool turns = evidence.gyroscope != nullptr && !evidence.gyroscope->isEmpty(),
             drives = evidence.wheels != nullptr && !evidence.wheels->isEmpty();
  if (!(seconds > 0.0) || (!turns && !drives)) return std::nullopt;
  Integration integration(evidence, q_odom_base);
  Coverage rates, speeds;
  if (drives) {
    const double offset = evidence.states->mean[MotionStates::kWheelOffset];
    double passed = 0.0;
    const auto turn = [&](const TwistSpan& span, double half) {
      const StampNs begin = from + toNs(passed);
      passed += half;
      if (!turns) return integration.turnByWheels(span, half);
      const Coverage part = integration.turn(begin, std::min(to, from + toNs(passed)));
      rates.measured += part.measured;
      rates.extrapolated += part.extrapolated;
      rates.bridged += part.bridged;
    };
    speeds =
        evidence.wheels->cover(delayed(from, offset), delayed(to, offset), [&](const TwistSpan& span, double piece) {
          turn(span, 0.5 * piece);
          integration.move(span, piece);
          turn(span, 0.5 * piece);
        });
  } else {
    rates = integration.turn(from, to);
  }
  if ((turns && !rates.suffices()) || (drives && !speeds.suffices())) return std::nullopt;
  integration.extrapolate(rates.extrapolated, speeds.extrapolated);
  return integration.finish(seconds);
}

}  // namespace urban_nav_core
