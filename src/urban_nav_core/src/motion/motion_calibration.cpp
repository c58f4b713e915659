// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/motion/motion_calibration.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_core {

namespace {

constexpr int kStates = MotionStates::kSize;

// Random walks per square root of a second: of the bias, 2.5 times that of EuRoC's sensor (ADIS16448); of clocks, 300
// ppm.
constexpr double kBiasWalk = 5e-5, kOffsetWalk = 3e-4, kScaleWalk = 2e-4;
// Resolution of encoders and of their stamps at each frame, independent of that of the reference: m, rad.
constexpr double kForwardEnd = 2e-3, kTurnEnd = 2e-3;
// Gain of the noise estimate per innovation, and limit of the normalised innovation squared.
constexpr double kNoiseGain = 0.01, kMostNis = 9.0;
// Limits of the noise relative to the stated variance; not below the stated one.
constexpr double kLeastNoise = 1.0, kMostNoise = 100.0;
// Innovations beyond this normalised square are outliers and do not update slow states.
constexpr double kOutlier = 25.0;

double prior(int state) {
  if (state < MotionStates::kImuOffset) return kBiasPrior;
  if (state == MotionStates::kSpeedScale) return kSpeedScalePrior;
  return state == MotionStates::kTurnScale ? kTurnScalePrior : kOffsetPrior;
}

double walk(int state) {
  if (state < MotionStates::kImuOffset) return kBiasWalk;
  const bool is_scale = state == MotionStates::kSpeedScale || state == MotionStates::kTurnScale;
  return is_scale ? kScaleWalk : kOffsetWalk;
}

}  // namespace

MotionCalibration::MotionCalibration() {
  for (int i = 0; i < kStates; ++i) restorePrior(i);
}

void MotionCalibration::restorePrior(int state) {
  P_.row(state).setZero();
  P_.col(state).setZero();
  P_(state, state) = prior(state) * prior(state);
  states_.mean[state] = 0.0;
  states_.covariance = P_.topLeftCorner<kStates, kStates>();
}

void MotionCalibration::forget(int first, int count) {
  for (int i = first; i < first + count; ++i) restorePrior(i);
}

void MotionCalibration::forgetGyroscope() {
  forget(MotionStates::kBias, 4);
  noise_[0] = 1.0;
}

void MotionCalibration::forgetWheels() {
  forget(MotionStates::kSpeedScale, 3);
  noise_[1] = 1.0;
}

void MotionCalibration::advance(double seconds) {
  for (int i = 0; i < kStates; ++i) P_(i, i) = std::min(P_(i, i) + walk(i) * walk(i) * seconds, prior(i) * prior(i));
  states_.covariance = P_.topLeftCorner<kStates, kStates>();
}

void MotionCalibration::update(const ReferenceStep& reference, bool follows,
                               const std::optional<GyroscopeStep>& gyroscope, const std::optional<WheelStep>& wheels) {
  constexpr int kBefore = kStates, kNow = kStates + kEnds;
  beginStep(reference, follows);
  if (gyroscope) {
    for (int axis = 0; axis < 3; ++axis) {
      Row row = Row::Zero();
      row.segment<3>(MotionStates::kBias) = gyroscope->bias.row(axis);
      row[MotionStates::kImuOffset] = gyroscope->offset[axis];
      row[kBefore + axis] = -1.0;
      row[kNow + axis] = 1.0;
      measure(row, gyroscope->error[axis], noise_[0] * gyroscope->variance + reference.rotation_drift, 0);
    }
  }
  if (wheels) {
    Row row = Row::Zero();
    row[MotionStates::kSpeedScale] = wheels->forward.scale;
    row[MotionStates::kWheelOffset] = wheels->forward.offset;
    row[kBefore + 3] = -1.0;
    row[kNow + 3] = 1.0;
    measure(row, wheels->forward.error, noise_[1] * wheels->forward.variance + reference.forward_drift, 1);
    row.setZero();
    row[MotionStates::kTurnScale] = wheels->turn.scale;
    row[MotionStates::kWheelOffset] = wheels->turn.offset;
    for (const int end : {2, 4}) {
      row[kBefore + end] = -1.0;
      row[kNow + end] = 1.0;
    }
    measure(row, wheels->turn.error, noise_[1] * wheels->turn.variance + reference.rotation_drift, 1);
  }
  endStep();
}

void MotionCalibration::beginStep(const ReferenceStep& reference, bool follows) {
  change_.head<kStates>().setZero();
  change_.tail<kEnds>().setZero();
  if (!follows) change_.segment<kEnds>(kStates).setZero();
  Eigen::Matrix<double, kEnds, 1> ends;
  ends << Vector3d::Constant(reference.rotation_end), reference.forward_end + kForwardEnd * kForwardEnd,
      kTurnEnd * kTurnEnd;
  const auto set = [&](int first) {
    P_.middleRows<kEnds>(first).setZero();
    P_.middleCols<kEnds>(first).setZero();
    P_.block<kEnds, kEnds>(first, first) = ends.asDiagonal();
  };
  if (!follows) set(kStates);
  set(kStates + kEnds);
}

// Scalar update: the noise of different axes is independent.
void MotionCalibration::measure(const Row& row, double error, double variance, int sensor) {
  const Row gain = P_ * row;
  const double innovation = error - row.dot(change_), of_innovation = row.dot(gain) + variance,
               nis = innovation * innovation / of_innovation;
  double& noise = noise_[sensor];
  noise = std::clamp(noise * (1.0 + kNoiseGain * (std::min(nis, kMostNis) - 1.0)), kLeastNoise, kMostNoise);
  if (nis > kOutlier) return;
  change_ += gain * (innovation / of_innovation);
  P_ -= gain * (gain / of_innovation).transpose();
}

// Shifts the states of this frame to those of the previous frame.
void MotionCalibration::endStep() {
  states_.mean += change_.head<kStates>();
  change_.segment<kEnds>(kStates) = change_.tail<kEnds>().eval();
  const Joint joint = P_;
  P_.block<kStates, kEnds>(0, kStates) = joint.block<kStates, kEnds>(0, kStates + kEnds);
  P_.block<kEnds, kStates>(kStates, 0) = joint.block<kEnds, kStates>(kStates + kEnds, 0);
  P_.block<kEnds, kEnds>(kStates, kStates) = joint.block<kEnds, kEnds>(kStates + kEnds, kStates + kEnds);
  P_ = (0.5 * (P_ + P_.transpose())).eval();
  states_.covariance = P_.topLeftCorner<kStates, kStates>();
}

void MotionCalibration::archive(Archive& archive) {
  archive(states_.mean, P_, change_, noise_);
  if (archive.isReading()) states_.covariance = P_.topLeftCorner<kStates, kStates>();
}

}  // namespace urban_nav_core
