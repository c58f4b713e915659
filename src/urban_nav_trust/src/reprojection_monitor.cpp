// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/reprojection_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/sequence/change_detector.hpp"

namespace urban_nav_trust {

using urban_nav_core::formatNumber;
using urban_nav_core::FrameMeasurements;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kReprojectionWindow = 1'000'000'000;
constexpr int kLeastReprojectionFrames = 3;
constexpr std::int64_t kReprojectionHorizon = 3600;  // windows per hour
// Errors far below a pixel measure templates and motion rather than the cameras: a stationary robot has 0.03 px, one
// that drives 0.3 px. Added in quadrature, px.
constexpr double kHarmlessError = 0.3;
// Standard deviation of the logarithm from second to second on sound drives (0.05 to 0.15 on three real ones and in
// simulation), rounded up, and the number of seconds that it counts for. A calm beginning is no reason for less.
constexpr double kPriorScatter = 0.2, kPriorWindows = 10.0;
// Neighbouring seconds show the same surfaces: with a correlation of one half, the sum of n of them has
// (1 + 0.5) / (1 - 0.5) times the variance of independent ones.
constexpr double kSharedScene = 3.0;
constexpr double kReprojectionDrift = 0.5;  // subtracted from each residual in the cumulative sum

constexpr const char* kReprojectionRemedy =
    "Landmarks no longer fit the images of the stereo cameras: a camera vibrates on its mount, is out of focus, has "
    "water or dirt on its lens, or was turned. Check the lenses and their mounts, inspect the images at that time, and "
    "map the part after it as a separate session if it lasts.";

/// Returns the normal deviate with the tail probability of Student's t with `dof` degrees of freedom, to 0.02 (Wallace
/// 1959).
double normalFromStudent(double t, double dof) {
  const double deviate = (8.0 * dof + 1.0) / (8.0 * dof + 3.0) * std::sqrt(dof * std::log1p(t * t / dof));
  return std::copysign(deviate, t);
}

/// Returns the root mean square error of a mean of logarithms, px.
double toPixels(double logarithm) {
  return std::sqrt(std::max(0.0, std::exp(2.0 * logarithm) - kHarmlessError * kHarmlessError));
}

}  // namespace

ReprojectionMonitor::ReprojectionMonitor(const Parameters& parameters)
    : false_alarm_(parameters.false_alarm),
      threshold_(urban_nav_core::ChangeDetector(false_alarm_, kReprojectionHorizon, 2).threshold()) {}

bool ReprojectionMonitor::add(const FrameMeasurements& frame) {
  if (!(frame.reprojection_px > 0.0) || !std::isfinite(frame.reprojection_px)) return false;
  bool rises = false;
  if (window_.frames > 0 && frame.stamp >= window_.interval.from + kReprojectionWindow) rises = closeWindow();
  if (window_.frames++ == 0) window_.interval.from = frame.stamp;
  window_.interval.to = frame.stamp;
  window_.squares += frame.reprojection_px * frame.reprojection_px;
  return rises;
}

bool ReprojectionMonitor::closeWindow() {
  const Window window = std::exchange(window_, Window());
  if (window.frames < kLeastReprojectionFrames) return false;
  const double variance = window.squares / window.frames + kHarmlessError * kHarmlessError;
  return addLogarithm(window.interval, 0.5 * std::log(variance));
}

bool ReprojectionMonitor::addLogarithm(const Interval& interval, double value) {
  if (!std::exchange(any_window_, true)) first_ = interval.from;
  last_ = interval.to;
  bool rises = false;
  if (windows_ > 0) {
    const double dof = kPriorWindows + static_cast<double>(scattered_);
    const double variance = kPriorScatter * kPriorScatter,
                 scatter = std::max(variance, (kPriorWindows * variance + squares_) / dof);
    const double residual = (value - mean_) / std::sqrt(1.0 + 1.0 / static_cast<double>(windows_));
    const double deviate = normalFromStudent(residual / std::sqrt(kSharedScene * scatter), dof);
    if (excursion_.windows == 0) excursion_.before = mean_;
    if (excursion_.windows++ == 0) excursion_.interval.from = interval.from;
    excursion_.interval.to = interval.to;
    excursion_.sum = std::max(0.0, excursion_.sum + deviate - kReprojectionDrift);
    excursion_.logs += value;
    excursion_.squares += residual * residual;
    if (excursion_.sum > largest_.sum) largest_ = excursion_;
    rises = excursion_.sum > threshold_ && !std::exchange(has_failed_, true);
    if (excursion_.sum == 0.0) {  // a rise is not scatter until it has gone
      squares_ += excursion_.squares;
      scattered_ += excursion_.windows;
      excursion_ = Excursion();
    }
  }
  mean_ += (value - mean_) / static_cast<double>(++windows_);
  return rises;
}

std::optional<ConsistencyTest> ReprojectionMonitor::test() const {
  if (windows_ < 2) return std::nullopt;
  ConsistencyTest test;
  test.name = kReprojectionTest;
  test.interval = {first_, last_};
  test.statistic = largest_.sum;
  test.degrees_of_freedom = static_cast<double>(windows_);
  test.p_value =
      urban_nav_core::changeProbability(largest_.sum, std::max<std::int64_t>(windows_, kReprojectionHorizon));
  test.remedy = kReprojectionRemedy;
  if (!(test.p_value < false_alarm_)) {
    test.sentence = "The reprojection error stays at " + formatNumber(toPixels(mean_)) + " px in " +
                    std::to_string(windows_) + " s: landmarks fit the images as well as at the beginning.";
    return test;
  }
  test.interval = largest_.interval;
  test.sentence = "The reprojection error rose from " + formatNumber(toPixels(largest_.before)) + " px to " +
                  formatNumber(toPixels(largest_.logs / static_cast<double>(largest_.windows))) + " px at " +
                  formatNumber(urban_nav_core::secondsBetween(first_, largest_.interval.from), 4) + " s, for " +
                  std::to_string(largest_.windows) + " s: " + formatNumber(largest_.sum, 3) +
                  " standard deviations in sum, more than " + formatNumber(threshold_, 3) + ".";
  return test;
}

}  // namespace urban_nav_trust
