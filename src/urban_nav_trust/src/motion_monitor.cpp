// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/motion_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"
#include "urban_nav_core/trajectory/normal_tail.hpp"

namespace urban_nav_trust {

using urban_nav_core::formatNumber;
using urban_nav_core::StampNs;

namespace {

constexpr std::int64_t kWindowsPerHour = 3600;
constexpr StampNs kWindow = 1'000'000'000;        // ns
constexpr StampNs kClockSpacing = 2'000'000'000;  // ns, between independent estimates of the delay
constexpr double kLeastForward = 0.3;             // m in a window, below which a ratio is undefined
// Differences of sound sensors within a second, in addition to noise: misalignment and scale errors of gyroscopes (0.2
// % of a turn of 1 rad), tyre slip (0.5 % of the distance) and lateral play of a wheel (3 mrad).
constexpr double kTurnFloor = 2e-3, kSlip = 5e-3, kPlay = 3e-3;
constexpr double kClockFloor = 2e-3;  // s, jitter of stamps
constexpr double kKnownDelay = 0.01;  // s, sigma below which the delay is considered known
// s: exposure, transfer and receipt delay the stamps of sensors without a common clock by up to this time.
constexpr double kTransport = 0.05;
// Probability that odometry excludes a sound sensor: three consecutive blocks that differ by at least four standard
// deviations in three axes (docs/derivations/motion_sensors.md).
constexpr double kExcluded = 1.5e-9;
// A scale is stated if it is known to this many standard deviations, leaves at most this share of a difference, and is
// one of a wrong calibration.
constexpr double kScaleKnown = 4.0, kExplained = 0.6, kLargestScale = 0.1;

/// Returns an upper bound of the probability that any of the windows has at least this chi-square (Bonferroni).
double turnProbability(double chi2, std::int64_t windows) {
  return std::min(1.0, static_cast<double>(windows) * (1.0 - urban_nav_core::chiSquareProbability(chi2, 3.0)));
}

}  // namespace

MotionMonitor::Constant::Constant(const Parameters& parameters) : detector(parameters.false_alarm, kWindowsPerHour) {}

MotionMonitor::MotionMonitor(const Parameters& parameters)
    : false_alarm_(parameters.false_alarm),
      speed_(parameters),
      direction_(parameters),
      clock_(parameters),
      turn_evidence_(kTurnFloor),
      length_evidence_(kSlip) {}

bool MotionMonitor::Exclusion::add(const std::string& fault, StampNs last, StampNs stamp) {
  const bool begins = !fault.empty() && !is_there;
  is_there = !fault.empty();
  if (!is_there) return false;
  if (!any()) interval.from = last;
  interval.to = stamp;
  sentence = fault;
  return begins;
}

void MotionMonitor::Exclusion::applyTo(const std::string& sensor, ConsistencyTest& test) const {
  test.interval = interval;
  test.p_value = std::min(test.p_value, kExcluded);
  test.is_corrected = !is_there;
  test.sentence =
      (is_there ? "Odometry does not use " : "For a time, odometry did not use ") + sensor + ": " + sentence + ".";
}

void MotionMonitor::add(const urban_nav_core::RelativePose& step) {
  const urban_nav_core::Matrix6d& drift = step.drift_covariance.isZero(0.0) ? step.covariance : step.drift_covariance;
  if (!drift.allFinite()) return;
  turn_drift_ += drift.bottomRightCorner<3, 3>().trace() / 3.0;
  forward_drift_ += drift(0, 0);
}

bool MotionMonitor::add(const urban_nav_core::FrameMeasurements& frame) {
  if (!any_frame_) last_ = frame.stamp;
  any_frame_ = true;
  bool changed = false;
  if (frame.turn_sigma > 0.0 && std::isfinite(frame.turn_sigma) && frame.turn_error.allFinite()) {
    if (turn_.turns++ == 0) turn_.interval.from = last_;
    turn_.interval.to = frame.stamp;
    if (frame.turn.allFinite()) turn_.turn += frame.turn;
    turn_.turn_error += frame.turn_error;
    turn_.turn_variance += frame.turn_sigma * frame.turn_sigma;
    if (turn_.interval.to - turn_.interval.from >= kWindow) changed |= closeTurnWindow();
  }
  if (frame.forward_sigma > 0.0 && std::isfinite(frame.forward_sigma) && std::isfinite(frame.forward_error) &&
      std::isfinite(frame.forward) && std::isfinite(frame.sideways)) {
    if (move_.moves++ == 0) move_.interval.from = last_;
    move_.interval.to = frame.stamp;
    move_.forward += frame.forward;
    move_.sideways += frame.sideways;
    move_.forward_error += frame.forward_error;
    move_.forward_variance += frame.forward_sigma * frame.forward_sigma;
    if (move_.interval.to - move_.interval.from >= kWindow) changed |= closeMoveWindow();
  }
  changed |= addClock(frame);
  changed |= no_gyroscope_.add(frame.gyroscope_fault, last_, frame.stamp);
  changed |= no_wheels_.add(frame.wheels_fault, last_, frame.stamp);
  last_ = frame.stamp;
  return changed;
}

bool MotionMonitor::closeTurnWindow() {
  const double variance = turn_.turn_variance + kTurnFloor * kTurnFloor;
  const double chi2 = turn_.turn_error.squaredNorm() / variance;
  scale_information_ += turn_.turn.squaredNorm() / variance;
  scale_weighted_ += turn_.turn.dot(turn_.turn_error) / variance;
  if (turn_windows_++ == 0) turn_span_.from = turn_.interval.from;
  turn_span_.to = turn_.interval.to;
  if (chi2 > largest_turn_) {
    largest_turn_ = chi2;
    worst_turn_ = turn_;
  }
  turn_evidence_.add(turn_.turn_error.squaredNorm(), 3.0, turn_drift_,
                     std::max(0.0, turn_.turn_variance - turn_drift_));
  turn_drift_ = 0.0;
  turn_ = Window();
  return turnProbability(chi2, kWindowsPerHour) < false_alarm_;
}

bool MotionMonitor::closeMoveWindow() {
  bool changed = false;
  if (std::abs(move_.forward) > kLeastForward) {
    const double noise = std::sqrt(move_.forward_variance) / std::abs(move_.forward);
    addLengthEvidence();
    changed |= speed_.add({move_.interval, move_.forward_error / move_.forward, std::hypot(noise, kSlip)});
    changed |= direction_.add({move_.interval, move_.sideways / move_.forward, std::hypot(noise, kPlay)});
  }
  forward_drift_ = 0.0;
  move_ = Window();
  return changed;
}

// The ratio of lengths is estimated from the previous windows.
void MotionMonitor::addLengthEvidence() {
  const std::vector<urban_nav_core::ChangeDetector::Segment> segments = speed_.detector.segments();
  if (segments.empty()) return;
  const double forward = std::abs(move_.forward), known = segments.back().sigma * forward,
               error = move_.forward_error - segments.back().mean * move_.forward;
  length_evidence_.add(error * error, 1.0, forward_drift_,
                       std::max(0.0, move_.forward_variance - forward_drift_) + known * known, forward);
}

bool MotionMonitor::addClock(const urban_nav_core::FrameMeasurements& frame) {
  if (!frame.gyroscope_fault.empty()) return false;
  std::tie(wheel_delay_, wheel_delay_sigma_) = std::tie(frame.wheel_delay, frame.wheel_delay_sigma);
  if (!(frame.imu_delay_sigma > 0.0 && frame.imu_delay_sigma < kKnownDelay) || !std::isfinite(frame.imu_delay) ||
      frame.stamp < clock_due_)
    return false;
  std::tie(imu_delay_, imu_delay_sigma_) = std::tie(frame.imu_delay, frame.imu_delay_sigma);
  clock_due_ = frame.stamp + kClockSpacing;
  return clock_.add({{last_, frame.stamp}, frame.imu_delay, std::hypot(frame.imu_delay_sigma, kClockFloor)}) ||
         delayProbability() < false_alarm_;
}

double MotionMonitor::excessDelay() const {
  return std::max(0.0, std::abs(imu_delay_) - kTransport) / std::hypot(imu_delay_sigma_, kClockFloor);
}

double MotionMonitor::delayProbability() const { return urban_nav_core::normalTwoSidedTail(excessDelay()); }

std::optional<ConsistencyTest> MotionMonitor::turnTest() const {
  if (turn_windows_ < 2 && !no_gyroscope_.any()) return std::nullopt;
  static constexpr double kDegrees = 180.0 / M_PI;
  ConsistencyTest test;
  test.name = kTurnTest;
  test.interval = turn_span_;
  test.statistic = largest_turn_;
  test.degrees_of_freedom = 3.0;
  test.p_value = turn_windows_ > 0 ? turnProbability(largest_turn_, turn_windows_) : 1.0;
  if (test.p_value < false_alarm_) test.interval = worst_turn_.interval;
  test.sentence = "Turns by stereo and by the gyroscope differ by up to " +
                  formatNumber(kDegrees * worst_turn_.turn_error.norm()) + " deg within a second (" +
                  std::to_string(turn_windows_) + " seconds compared).";
  test.remedy =
      "The stereo head or the IMU has moved, or one of them fails: fasten both, measure their mounting again "
      "(/tf_static), and check their clocks.";
  if (test.p_value < false_alarm_) nameTurnScale(test);
  if (no_gyroscope_.is_there || (no_gyroscope_.any() && !(test.p_value < false_alarm_)))
    no_gyroscope_.applyTo("the gyroscope", test);
  return test;
}

void MotionMonitor::nameTurnScale(ConsistencyTest& test) const {
  if (!(scale_information_ > 0.0)) return;
  const double scale = scale_weighted_ / scale_information_, sigma = 1.0 / std::sqrt(scale_information_);
  const double rest = (worst_turn_.turn_error - scale * worst_turn_.turn).norm();
  if (!(std::abs(scale) > kScaleKnown * sigma) || std::abs(scale) > kLargestScale ||
      rest > kExplained * worst_turn_.turn_error.norm())
    return;
  test.interval = turn_span_;
  test.sentence += " They differ by a scale: those by stereo are " + formatNumber(100.0 * std::abs(scale)) + " % (+-" +
                   formatNumber(100.0 * sigma, 2) + ") " + (scale > 0.0 ? "larger." : "smaller.");
  test.remedy =
      "The focal length of the cameras (camera_info), and with it all lengths, or the scale of the gyroscope is wrong: "
      "calibrate the cameras.";
}

std::optional<ConsistencyTest> MotionMonitor::speedTest() const {
  static constexpr Wording kSpeed = {
      kSpeedTest, "The excess of distances by stereo over those by the wheels", "%",
      "The scale of stereo or of the wheels has changed: calibrate the stereo pair; check tyres and slip.", 100.0};
  std::optional<ConsistencyTest> test = makeTest(kSpeed, speed_);
  const bool has_changed = test && test->p_value < false_alarm_;
  if (!no_wheels_.any() || (has_changed && !no_wheels_.is_there)) return test;
  if (!test) {
    test = ConsistencyTest();
    test->name = kSpeed.name;
    test->remedy = kSpeed.remedy;
  }
  no_wheels_.applyTo("the wheels", *test);
  return test;
}

std::optional<ConsistencyTest> MotionMonitor::clockTest() const {
  static constexpr Wording kClock = {
      kClockTest, "The delay of the IMU's stamps relative to those of the cameras", "ms",
      "The clocks of the cameras and of the IMU drift apart: synchronise them (input.imu_delay corrects only a "
      "constant delay).",
      1e3};
  std::optional<ConsistencyTest> test = makeTest(kClock, clock_);
  if (!test || test->p_value < false_alarm_) return test;
  const double p_value = delayProbability();
  if (!(p_value < false_alarm_)) return test;
  const auto ms = [](double delay) { return formatNumber(1e3 * std::abs(delay), 3) + " ms"; };
  const bool is_early = imu_delay_ < 0.0;
  const bool wheels_too =
      wheel_delay_sigma_ > 0.0 && wheel_delay_sigma_ < kKnownDelay && std::abs(wheel_delay_ - imu_delay_) < kTransport;
  test->statistic = excessDelay();
  test->degrees_of_freedom = 1.0;
  test->p_value = p_value;
  if (wheels_too) {
    test->sentence = "The stamps of the cameras are " + ms(imu_delay_) + (is_early ? " later" : " earlier") +
                     " than those of the IMU, and " + ms(wheel_delay_) + " than those of the wheels.";
    test->remedy =
        "The clock of the cameras is wrong, or their driver stamps images when it receives them: synchronise the "
        "clocks (chrony, PTP). Odometry has corrected IMU and wheels only; lasers and GPS on the same clock are off by "
        "this time: set input.imu_delay, wheels_delay, laser_left_delay, laser_right_delay and gps_delay to " +
        formatNumber(1e3 * imu_delay_, 3) + ".";
  } else {
    test->sentence = "The IMU's stamps are " + ms(imu_delay_) + (is_early ? " earlier" : " later") +
                     " than those of the cameras, longer than a transfer takes.";
    test->remedy = "One of both clocks is wrong: synchronise them (chrony, PTP), or set input.imu_delay to " +
                   formatNumber(1e3 * imu_delay_, 3) + " if the cameras are right.";
  }
  return test;
}

std::optional<ConsistencyTest> MotionMonitor::makeTest(const Wording& wording, const Constant& constant) {
  const std::int64_t count = constant.detector.measurements();
  if (count < 2) return std::nullopt;
  const std::vector<urban_nav_core::ChangeDetector::Segment> segments = constant.detector.segments();
  const bool has_changed = segments.size() > 1;
  ConsistencyTest test;
  test.name = wording.name;
  test.interval = {has_changed ? segments[1].interval.from : segments.front().interval.from,
                   segments.back().interval.to};
  test.statistic = constant.detector.statistic();
  test.degrees_of_freedom = static_cast<double>(count);
  test.p_value = urban_nav_core::changeProbability(test.statistic, std::max(count, kWindowsPerHour));
  test.remedy = wording.remedy;
  const auto value = [&](const urban_nav_core::ChangeDetector::Segment& segment) {
    return formatNumber(wording.per_unit * segment.mean) + " " + wording.unit + " (+-" +
           formatNumber(wording.per_unit * segment.sigma, 2) + ")";
  };
  if (!has_changed)
    test.sentence = std::string(wording.quantity) + " stays at " + value(segments.front()) + " in " +
                    std::to_string(count) + " measurements.";
  else
    test.sentence =
        std::string(wording.quantity) + " changed from " + value(segments.front()) + " to " + value(segments[1]) + ".";
  return test;
}

std::vector<ConsistencyTest> MotionMonitor::tests() const {
  static constexpr double kDegrees = 180.0 / M_PI;
  static constexpr Wording kDirection = {
      kDirectionTest, "The angle from the robot's x axis to the direction of travel by stereo", "deg",
      "The stereo head has turned on its mount: fasten it and measure its mounting again (/tf_static).", kDegrees};
  std::vector<ConsistencyTest> tests;
  const auto append = [&](std::optional<ConsistencyTest> test) {
    if (test) tests.push_back(std::move(*test));
  };
  append(turnTest());
  append(speedTest());
  append(makeTest(kDirection, direction_));
  append(clockTest());
  return tests;
}

std::vector<AbsentMeasurement> MotionMonitor::absent() const {
  std::vector<AbsentMeasurement> absent;
  const auto check = [&](const char* name, const Constant& constant, const char* reason) {
    if (constant.detector.measurements() < 2 && !(name == kSpeedTest && no_wheels_.any()))
      absent.push_back({name, reason});
  };
  if (turn_windows_ < 2 && !no_gyroscope_.any())
    absent.push_back({kTurnTest, "no gyroscope data with images for two seconds"});
  check(kSpeedTest, speed_, "no wheel odometry with images for two seconds of motion");
  check(kDirectionTest, direction_, "no wheel odometry with images for two seconds of motion");
  check(kClockTest, clock_, "no gyroscope data, or too few turns to estimate their delay");
  return absent;
}

}  // namespace urban_nav_trust
