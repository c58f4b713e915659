// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/motion/motion_sensors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/inertial/rotation_preintegration.hpp"
#include "urban_nav_core/io/archive_types.hpp"

namespace urban_nav_core {

namespace {

// Differences over a quarter of a second that are always tolerated: rad, m.
constexpr double kTurnFloor = 2e-3, kForwardFloor = 0.01;
// The newest step is not settled: it contradicts beyond this multiple of the floors and this share of the motion.
constexpr double kFarInOneStep = 4.0, kLargeShareOfStep = 0.5;
// A bias or scale beyond kBeyond standard deviations of its prior is a fault if its estimate is as accurate as
// kWellKnown (rad/s, ratio). A scale, which other faults do not resemble, also if the excess is kSignificant standard
// deviations of the estimate.
constexpr double kBeyond = 2.0, kWellKnown = 0.02, kSignificant = 3.0;
// Half of the averaging time of rates at the ends of a step, s.
constexpr double kRateWindow = 0.1;
// Sensor history kept before the newest settled frame, for clock offsets, ns.
constexpr StampNs kHistory = 1'000'000'000;
constexpr std::size_t kMostFaults = 20;

double meanDiagonal(const Matrix6d& covariance, int first, int count) {
  return std::max(0.0, covariance.diagonal().segment(first, count).mean());
}

ReferenceStep toReferenceStep(const RelativePose& step) {
  ReferenceStep reference;
  reference.seconds = secondsBetween(step.from, step.to);
  reference.rotation = logSo3(step.T_from_to.q());
  reference.forward = step.T_from_to.t().x();
  reference.rotation_drift = meanDiagonal(step.drift_covariance, 3, 3);
  reference.rotation_end = 0.5 * std::max(0.0, meanDiagonal(step.covariance, 3, 3) - reference.rotation_drift);
  reference.forward_drift = meanDiagonal(step.drift_covariance, 0, 1);
  reference.forward_end = 0.5 * std::max(0.0, meanDiagonal(step.covariance, 0, 1) - reference.forward_drift);
  return reference;
}

/// Returns whether a scale of the wheels (measured over true, minus 1) is too large for working ones.
bool isBeyondScales(double mean, double sigma) {
  const double excess = std::abs(mean) - kBeyond * kSpeedScalePrior;
  return excess > 0.0 && (sigma < kWellKnown || excess > kSignificant * sigma);
}

/// Returns the mean twist around a stamp of the sensor.
Vector6d smoothTwist(const TwistStream& stream, StampNs stamp) {
  Vector6d sum = Vector6d::Zero();
  double seconds = 0.0;
  stream.cover(delayed(stamp, -kRateWindow), delayed(stamp, kRateWindow), [&](const TwistSpan& span, double piece) {
    sum += piece * span.twist;
    seconds += piece;
  });
  return sum / seconds;
}

}  // namespace

void archive(Archive& archive, MeasuredStep& step) {
  Pose end(step.q_odom_base, Vector3d::Zero());
  archive(step.frame, step.stamp, step.step, end, step.health, step.measures_turn, step.measures_forward);
  step.q_odom_base = end.q();
}

MotionSensors::MotionSensors() : MotionSensors(Options()) {}

MotionSensors::MotionSensors(Options options)
    : options_(std::move(options)), gyroscope_(kTurnFloor), wheels_(kForwardFloor) {
  notes_.reserve(64);
}

void MotionSensors::add(const std::vector<MotionInput>& inputs) {
  estimates_.newest = {};
  for (const MotionInput& input : inputs) append(input);
}

void MotionSensors::append(const MotionInput& input) {
  if (input.source == MotionSource::Gyroscope) {
    gyroscope_.stream.add(input);
    up_.add(input);
    q_base_imu_ = input.q_base_sensor;
  } else if (input.source == MotionSource::Wheels) {
    wheels_.stream.add(input);
  }
}

StampNs MotionSensors::newestRate() const {
  return delayed(gyroscope_.stream.newest().to, -calibration_.states().mean[MotionStates::kImuOffset]);
}

BodyTwist MotionSensors::velocity(BodyTwist steady) const {
  const MotionStates& states = calibration_.states();
  const auto replace = [&](int row, double value, double variance) {
    steady.twist[row] = value;
    steady.covariance.row(row).setZero();
    steady.covariance.col(row).setZero();
    steady.covariance(row, row) = variance;
  };
  if (mayPredict(gyroscope_)) {
    const TwistSpan& span = gyroscope_.stream.newest();
    const double white = calibration_.gyroscopeNoise() * rateDensity(gyroscope_.stream, span) / span.seconds();
    for (int i = 0; i < 3; ++i) replace(3 + i, span.twist[3 + i] - states.bias()[i], white);
    steady.covariance.bottomRightCorner<3, 3>() += states.covariance.topLeftCorner<3, 3>();
  }
  if (mayPredict(wheels_)) {
    const TwistSpan& span = wheels_.stream.newest();
    constexpr int kScale = MotionStates::kSpeedScale;
    const double scale = 1.0 + states.mean[kScale], speed = span.twist[0] / scale;
    replace(0, speed,
            (calibration_.wheelNoise() * span.density[0] / span.seconds() +
             speed * speed * states.covariance(kScale, kScale)) /
                (scale * scale));
  }
  return steady;
}

void MotionSensors::continueUnmeasured(StampNs to, double seconds) {
  since_measured_ += seconds;
  for (Sensor* sensor : {&gyroscope_, &wheels_}) sensor->stream.forget(to - kHistory);
}

std::optional<Reckoned> MotionSensors::predict(StampNs from, StampNs to, const Quaterniond& q_odom_base,
                                               std::optional<double> forward_unmeasured) const {
  GroundSlope ground = ground_;
  if (const auto up = up_.estimate()) ground = ground_.levelled(up->up, up->sigma);
  MotionEvidence evidence;
  evidence.states = &calibration_.states();
  evidence.ground = &ground;
  evidence.gyroscope_noise = calibration_.gyroscopeNoise();
  evidence.wheel_noise = calibration_.wheelNoise();
  evidence.turn_unmeasured = since_measured_;
  evidence.forward_unmeasured = forward_unmeasured.value_or(since_measured_);
  const TwistStream* const gyroscope = mayPredict(gyroscope_) ? &gyroscope_.stream : nullptr;
  const TwistStream* const wheels = mayPredict(wheels_) ? &wheels_.stream : nullptr;
  const std::array<std::pair<const TwistStream*, const TwistStream*>, 3> choices = {
      {{gyroscope, wheels}, {gyroscope, nullptr}, {nullptr, wheels}}};
  for (const auto& [turns, drives] : choices) {
    evidence.gyroscope = turns;
    evidence.wheels = drives;
    std::optional<Reckoned> reckoned = reckon(evidence, from, to, q_odom_base);
    if (!reckoned) continue;
    const bool is_finite = reckoned->covariance.allFinite() && reckoned->T_from_to.isFinite();
    return is_finite ? reckoned : std::nullopt;
  }
  return std::nullopt;
}

void MotionSensors::addFrame(std::int64_t frame, double seconds, bool by_reference, bool reckoned) {
  since_measured_ = by_reference ? 0.0 : since_measured_ + seconds;
  if (gyroscope_.stream.isEmpty() && wheels_.stream.isEmpty()) return;
  notes_.push_back({frame, reckoned});
}

void MotionSensors::check(const MeasuredStep& newest) {
  const StampNs from = newest.step.from, to = newest.step.to;
  const Pose& base = newest.step.T_from_to;
  const MotionStates& states = calibration_.states();
  const auto contradicts = [](double error, double motion, double floor) {
    return error > kFarInOneStep * floor && error > kLargeShareOfStep * motion;
  };
  if (newest.measures_turn && !gyroscope_.stream.isEmpty()) {
    const double offset = states.mean[MotionStates::kImuOffset];
    RotationPreintegration turned(states.bias());
    const Coverage coverage = gyroscope_.stream.cover(
        delayed(from, offset), delayed(to, offset),
        [&](const TwistSpan& span, double seconds) { turned.add(span.twist.tail<3>(), seconds, 0.0); });
    const Quaterniond by_gyroscope = turned.rotation();
    const double motion = std::max(logSo3(base.q()).norm(), logSo3(by_gyroscope).norm());
    if (coverage.isComplete())
      gyroscope_.is_contradicted = contradicts(by_gyroscope.angularDistance(base.q()), motion, kTurnFloor);
  }
  if (newest.measures_forward && !wheels_.stream.isEmpty()) {
    const double offset = states.mean[MotionStates::kWheelOffset], scale = 1.0 + states.mean[MotionStates::kSpeedScale];
    double distance = 0.0;
    const Coverage coverage = wheels_.stream.cover(
        delayed(from, offset), delayed(to, offset),
        [&](const TwistSpan& span, double seconds) { distance += span.twist[0] / scale * seconds; });
    const double motion = std::max(std::abs(base.t().x()), std::abs(distance));
    if (coverage.isComplete())
      wheels_.is_contradicted = contradicts(std::abs(distance - base.t().x()), motion, kForwardFloor);
  }
}

void MotionSensors::learn(const MeasuredStep& settled) {
  estimates_.newest = {};
  const auto note =
      std::find_if(notes_.begin(), notes_.end(), [&](const FrameNote& each) { return each.frame == settled.frame; });
  const bool known = note != notes_.end(), reckoned = known && note->reckoned;
  if (known) notes_.erase(notes_.begin(), note + 1);
  const bool measured = any_settled_ && known && start_is_sound_ && settled.health == Health::Ok && !reckoned;
  any_settled_ = true;
  start_is_sound_ = settled.health == Health::Ok || settled.health == Health::Recovered;
  for (Sensor* sensor : {&gyroscope_, &wheels_}) {
    if (!measured) sensor->agreement.interrupt();
    sensor->stream.forget(settled.stamp - kHistory);
  }
  if (measured) learnStep(settled);
  else if (known) calibration_.advance(secondsBetween(settled.step.from, settled.step.to));
  follows_ = measured;
  if (known) write();
}

void MotionSensors::learnStep(const MeasuredStep& settled) {
  const RelativePose& step = settled.step;
  const ReferenceStep reference = toReferenceStep(step);
  if (!(reference.seconds > 0.0)) return;
  calibration_.advance(reference.seconds);
  if (!gyroscope_.is_left_out)
    up_.addStep(step.from, step.to, step.T_from_to, settled.q_odom_base, follows_ && settled.measures_forward);
  std::optional<Compared> turned, moved;
  std::optional<GyroscopeStep> gyroscope;
  std::optional<WheelStep> wheels;
  if (settled.measures_turn) gyroscope = compareGyroscope(settled, reference, turned);
  if (settled.measures_turn && settled.measures_forward) wheels = compareWheels(settled, reference, moved);
  calibration_.update(reference, follows_, gyroscope, wheels);
  if (turned) {
    estimates_.newest.turn = reference.rotation;
    estimates_.newest.turn_error = turned->error;
    estimates_.newest.turn_sigma = std::sqrt(turned->variance / 3.0);
  }
  if (moved) {
    estimates_.newest.forward = reference.forward;
    estimates_.newest.sideways = step.T_from_to.t().y();
    estimates_.newest.forward_error = moved->stated_error;
    estimates_.newest.forward_sigma = std::sqrt(moved->stated_variance);
  }
  if (turned) gyroscope_.agreement.add(turned->step, turned->error, turned->variance);
  else gyroscope_.agreement.interrupt();
  if (moved) wheels_.agreement.add(moved->step, moved->error, moved->variance);
  else wheels_.agreement.interrupt();
  if (!gyroscope_.stream.isEmpty()) decide(gyroscope_, false, settled.stamp);
  if (wheels_.stream.isEmpty()) return;
  decide(wheels_, true, settled.stamp);
  if (!settled.measures_forward) return;
  const Vector3d moved_in_odom = settled.q_odom_base * (step.T_from_to.q().conjugate() * step.T_from_to.t());
  ground_.learn(moved_in_odom, step.covariance.topLeftCorner<3, 3>().diagonal().maxCoeff());
}

std::optional<GyroscopeStep> MotionSensors::compareGyroscope(const MeasuredStep& settled,
                                                             const ReferenceStep& reference,
                                                             std::optional<Compared>& compared) const {
  const TwistStream& stream = gyroscope_.stream;
  if (stream.isEmpty()) return std::nullopt;
  const RelativePose& step = settled.step;
  const MotionStates& states = calibration_.states();
  const double offset = states.mean[MotionStates::kImuOffset];
  RotationPreintegration corrected(states.bias()), stated;
  const StampNs from = delayed(step.from, offset), to = delayed(step.to, offset);
  const Coverage coverage = stream.cover(from, to, [&](const TwistSpan& span, double seconds) {
    corrected.add(span.twist.tail<3>(), seconds, rateDensity(stream, span));
  });
  if (!coverage.isComplete()) return std::nullopt;
  stream.cover(step.from, step.to,
               [&](const TwistSpan& span, double seconds) { stated.add(span.twist.tail<3>(), seconds, 0.0); });
  const RotationResidual residual =
      rotationResidual(corrected, Quaterniond::Identity(), step.T_from_to.q(), states.bias());
  GyroscopeStep result;
  result.error = residual.e;
  result.bias = -residual.bias;
  result.offset = smoothTwist(stream, to).tail<3>() - states.bias() -
                  corrected.rotation().conjugate() * Vector3d(smoothTwist(stream, from).tail<3>() - states.bias());
  result.variance = corrected.covariance().trace() / 3.0;
  Eigen::Matrix<double, 3, 4> J;
  J << result.bias, result.offset;
  Compared checked;
  checked.step = {step.to, reference.seconds, reference.rotation, logSo3(stated.rotation())};
  checked.error = result.error;
  checked.variance = 3.0 * (result.variance + reference.rotation_drift + 2.0 * reference.rotation_end) +
                     (J * states.covariance.topLeftCorner<4, 4>() * J.transpose()).trace();
  compared = checked;
  return result;
}

std::optional<WheelStep> MotionSensors::compareWheels(const MeasuredStep& settled, const ReferenceStep& reference,
                                                      std::optional<Compared>& compared) const {
  const TwistStream& stream = wheels_.stream;
  if (stream.isEmpty()) return std::nullopt;
  const RelativePose& step = settled.step;
  const MotionStates& states = calibration_.states();
  const double offset = states.mean[MotionStates::kWheelOffset],
               speed_scale = 1.0 + states.mean[MotionStates::kSpeedScale],
               turn_scale = 1.0 + states.mean[MotionStates::kTurnScale];
  const StampNs from = delayed(step.from, offset), to = delayed(step.to, offset);
  Pose corrected, stated;
  WheelStep result;
  const Coverage coverage = stream.cover(from, to, [&](const TwistSpan& span, double seconds) {
    corrected = corrected * expSe3(span.twist * seconds);
    result.forward.variance += span.density[0] * seconds;
    result.turn.variance += span.density[5] * seconds;
  });
  if (!coverage.isComplete()) return std::nullopt;
  stream.cover(step.from, step.to,
               [&](const TwistSpan& span, double seconds) { stated = stated * expSe3(span.twist * seconds); });
  const Vector6d change = smoothTwist(stream, to) - smoothTwist(stream, from);
  const double forward = corrected.t().x() / speed_scale, turn = logSo3(corrected.q()).z() / turn_scale;
  result.forward.error = reference.forward - forward;
  result.forward.scale = -reference.forward / speed_scale;
  result.forward.offset = change[0] / speed_scale;
  result.forward.variance /= speed_scale * speed_scale;
  result.turn.error = reference.rotation.z() - turn;
  result.turn.scale = -reference.rotation.z() / turn_scale;
  result.turn.offset = change[5] / turn_scale;
  result.turn.variance /= turn_scale * turn_scale;
  const Eigen::Vector2d J(result.forward.scale, result.forward.offset);
  Eigen::Matrix2d P;
  P << states.covariance(MotionStates::kSpeedScale, MotionStates::kSpeedScale),
      states.covariance(MotionStates::kSpeedScale, MotionStates::kWheelOffset),
      states.covariance(MotionStates::kSpeedScale, MotionStates::kWheelOffset),
      states.covariance(MotionStates::kWheelOffset, MotionStates::kWheelOffset);
  Compared checked;
  checked.step = {step.to, reference.seconds, {reference.forward, 0.0, 0.0}, {stated.t().x(), 0.0, 0.0}};
  checked.error = {result.forward.error, 0.0, 0.0};
  checked.variance = result.forward.variance + reference.forward_drift + 2.0 * reference.forward_end + J.dot(P * J);
  checked.stated_error = reference.forward - corrected.t().x();
  checked.stated_variance = speed_scale * speed_scale * result.forward.variance + reference.forward_drift +
                            2.0 * reference.forward_end + change[0] * change[0] * P(1, 1);
  compared = checked;
  return result;
}

bool MotionSensors::isBiasBeyondPrior() const {
  const MotionStates& states = calibration_.states();
  const double sigma = std::sqrt(states.covariance.topLeftCorner<3, 3>().diagonal().maxCoeff());
  return sigma < kWellKnown && states.bias().cwiseAbs().maxCoeff() > kBeyond * kBiasPrior;
}

void MotionSensors::decide(Sensor& sensor, bool is_wheels, StampNs stamp) {
  const MotionStates& states = calibration_.states();
  constexpr int kScale = MotionStates::kSpeedScale;
  const bool beyond = is_wheels ? isBeyondScales(states.mean[kScale], std::sqrt(states.covariance(kScale, kScale)))
                                : isBiasBeyondPrior();
  const Agreement::Verdict verdict = sensor.agreement.verdict();
  if (verdict == Agreement::Verdict::Contradicts || beyond) {
    const bool was_used = sensor.is_used;
    leaveOut(sensor, is_wheels, stamp);
    if (verdict != Agreement::Verdict::Contradicts) return;
    sensor.agreement.restart(was_used);
    if (is_wheels) calibration_.forgetWheels();
    else calibration_.forgetGyroscope();
    return;
  }
  if (verdict != Agreement::Verdict::Agrees) return;
  if (sensor.is_left_out)
    for (auto fault = estimates_.faults.rbegin(); fault != estimates_.faults.rend(); ++fault)
      if (fault->is_wheels == is_wheels && fault->until == 0) fault->until = stamp;
  sensor.is_left_out = false;
  sensor.is_used = true;
}

void MotionSensors::leaveOut(Sensor& sensor, bool is_wheels, StampNs stamp) {
  std::vector<MotionSensorFault>& faults = estimates_.faults;
  const auto open = std::find_if(faults.begin(), faults.end(), [&](const MotionSensorFault& each) {
    return each.is_wheels == is_wheels && each.until == 0;
  });
  const bool goes_on = sensor.is_left_out && open != faults.end();
  sensor.is_used = false;
  sensor.is_left_out = true;
  if (goes_on && open->is_named) return;
  DiagnosisInput input;
  input.repeated_s = sensor.stream.repeatedSeconds();
  input.reference = options_.reference;
  input.q_base_sensor = is_wheels ? Quaterniond::Identity() : q_base_imu_;
  if (!is_wheels && isBiasBeyondPrior()) input.bias = calibration_.states().bias();
  const MotionFault fault =
      is_wheels ? diagnoseWheels(sensor.agreement.steps(), input) : diagnoseGyroscope(sensor.agreement.steps(), input);
  const bool is_named = fault.kind != MotionFault::Kind::Unknown;
  if (goes_on && is_named) {  // more data than at the first diagnosis
    open->sentence = fault.sentence;
    open->is_named = true;
  } else if (!goes_on && faults.size() < kMostFaults) {
    faults.push_back({is_wheels, is_named, stamp, 0, fault.sentence});
  }
}

void MotionSensors::write() {
  const MotionStates& states = calibration_.states();
  const auto sigma = [&](int state) { return std::sqrt(states.covariance(state, state)); };
  estimates_.has_gyroscope = !gyroscope_.stream.isEmpty();
  estimates_.uses_gyroscope = isInUse(gyroscope_) && !gyroscope_.stream.isEmpty();
  estimates_.gyroscope_left_out = gyroscope_.is_left_out;
  estimates_.has_wheels = !wheels_.stream.isEmpty();
  estimates_.uses_wheels = isInUse(wheels_) && !wheels_.stream.isEmpty();
  estimates_.wheels_left_out = wheels_.is_left_out;
  const Matrix3d R = q_base_imu_.toRotationMatrix();
  estimates_.gyroscope_bias = R.transpose() * states.bias();
  estimates_.gyroscope_bias_sigma =
      (R.transpose() * states.covariance.topLeftCorner<3, 3>() * R).diagonal().cwiseMax(0.0).cwiseSqrt();
  estimates_.imu_offset_s = states.mean[MotionStates::kImuOffset];
  estimates_.imu_offset_sigma_s = sigma(MotionStates::kImuOffset);
  estimates_.wheel_scale = 1.0 + states.mean[MotionStates::kSpeedScale];
  estimates_.wheel_scale_sigma = sigma(MotionStates::kSpeedScale);
  estimates_.wheel_turn_scale = 1.0 + states.mean[MotionStates::kTurnScale];
  estimates_.wheel_turn_scale_sigma = sigma(MotionStates::kTurnScale);
  estimates_.wheel_offset_s = states.mean[MotionStates::kWheelOffset];
  estimates_.wheel_offset_sigma_s = sigma(MotionStates::kWheelOffset);
}

void MotionSensors::archive(Archive& archive) {
  Pose imu(q_base_imu_, Vector3d::Zero());
  archive(imu);
  q_base_imu_ = imu.q();
  archive(gyroscope_, wheels_, calibration_, ground_, up_, notes_, estimates_);
  archive(since_measured_, any_settled_, follows_, start_is_sound_);
}

}  // namespace urban_nav_core
