// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/offset_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_trust {

using urban_nav_core::formatNumber;
using urban_nav_core::FrameMeasurements;
using urban_nav_core::StampNs;

namespace {

constexpr std::int64_t kHorizon = 20 * 3600;  // frames per hour: the alarm is set for sessions of that length
// Consecutive frames measure the same landmarks: the sum of n steps has this many times the variance of n independent
// ones (docs/derivations/trust.md).
constexpr double kSharedLandmarks = 3.0;
constexpr double kStepFloor = 0.02;  // px, error common to all landmarks of a frame: templates, rectification
constexpr double kDrift = 0.5;       // subtracted from each residual in the cumulative sum
// Odometry takes a turn if the robust cost of all landmarks falls by more than the quantile 1e-6 of a chi-square
// variable (docs/derivations/rig_constants.md).
constexpr double kTurnProbability = 1e-6;

constexpr const char* kRemedy =
    "The left or the right camera of the stereo pair was turned or displaced relative to the other, and odometry could "
    "not correct its images: lengths measured since then are wrong. Fasten the mount, calibrate the pair, and map the "
    "part after the change as a separate session.";
constexpr const char* kCorrectedRemedy =
    "Images after the change were corrected, so the map can be used. Fasten the mount of the stereo cameras and "
    "calibrate the pair before the next session.";

/// Returns the standard deviation of a step whose landmarks neighbouring frames share, px.
double deviation(double sigma_px) { return std::sqrt(kSharedLandmarks) * std::hypot(sigma_px, kStepFloor); }

}  // namespace

OffsetMonitor::OffsetMonitor(const Parameters& parameters)
    : false_alarm_(parameters.false_alarm), detector_(false_alarm_, kHorizon) {}

bool OffsetMonitor::add(const FrameMeasurements& frame) {
  if (!any_frame_) first_ = last_ = frame.stamp;
  any_frame_ = true;
  const double sigma_px = frame.disparity_step_sigma_px;
  if (!std::isfinite(frame.disparity_step_px) || !(sigma_px > 0.0) || !std::isfinite(sigma_px)) return false;
  ++frames_;
  const Interval interval{last_, frame.stamp};
  last_ = frame.stamp;
  if (frame.right_turn.allFinite() && frame.right_turn != turn_) return addTurn(interval, frame);
  return addStep(interval, frame.disparity_step_px, sigma_px);
}

bool OffsetMonitor::addStep(const Interval& interval, double step_px, double sigma_px) {
  if (interval.to < quiet_until_) return false;
  const bool alarm = detector_.add({interval, step_px, deviation(sigma_px)});
  largest_ = std::max(largest_, detector_.statistic());
  if (!alarm) return false;
  const std::vector<urban_nav_core::ChangeDetector::Segment> segments = detector_.segments();
  const urban_nav_core::ChangeDetector::Segment &before = segments[segments.size() - 2], &after = segments.back();
  Change change;
  change.stamp = after.interval.from;
  change.px = after.mean - before.mean;
  change.sigma_px = std::hypot(before.sigma, after.sigma);
  append(change, interval.to);
  return true;
}

// Odometry corrects a turn in the frame in which it measures it, by the first measurements after the change; later
// frames may refine it.
bool OffsetMonitor::addTurn(const Interval& interval, const FrameMeasurements& frame) {
  const Eigen::Vector3d growth = frame.right_turn - turn_;
  turn_ = frame.right_turn;
  if (!changes_.empty() && interval.to < quiet_until_) {
    Change& last = changes_.back();
    last.turn += growth;
    if (!last.is_corrected) last.corrected_at = interval.to;
    last.is_corrected = true;
    return true;
  }
  Change change;
  change.stamp = interval.from;
  change.sigma_px = deviation(frame.disparity_step_sigma_px);
  change.px = frame.disparity_step_px - detector_.mean();
  if (detector_.measurements() > 0) change.sigma_px = std::hypot(change.sigma_px, detector_.meanSigma());
  change.is_corrected = true;
  change.corrected_at = interval.to;
  change.turn = growth;
  largest_ = std::max(largest_, std::abs(change.px) / change.sigma_px - kDrift);
  append(change, interval.to);
  return true;
}

void OffsetMonitor::append(const Change& change, StampNs now) {
  changes_.push_back(change);
  detector_ = urban_nav_core::ChangeDetector(false_alarm_, kHorizon);
  quiet_until_ = now + kLandmarkRenewal;
}

bool OffsetMonitor::allCorrected() const {
  return std::all_of(changes_.begin(), changes_.end(), [](const Change& change) { return change.is_corrected; });
}

std::string OffsetMonitor::describe(const Change& change) const {
  std::string text = "by " + formatNumber(change.px) + " px (+-" + formatNumber(change.sigma_px, 2) + ") at " +
                     formatNumber(urban_nav_core::secondsBetween(first_, change.stamp), 4) + " s";
  if (!change.is_corrected) return text;
  const Eigen::Vector3d degrees = 180.0 / M_PI * change.turn;
  return text + ", where the right camera turned by " + formatNumber(degrees.x(), 2) + " deg in pitch, " +
         formatNumber(degrees.y(), 2) + " in yaw and " + formatNumber(degrees.z(), 2) +
         " in roll relative to the left one; odometry measured this and corrected its images from " +
         formatNumber(urban_nav_core::secondsBetween(first_, change.corrected_at), 4) + " s on";
}

std::optional<ConsistencyTest> OffsetMonitor::test() const {
  if (frames_ < 2) return std::nullopt;
  ConsistencyTest test;
  test.name = kOffsetTest;
  test.interval = {first_, last_};
  test.statistic = largest_;
  test.degrees_of_freedom = static_cast<double>(frames_);
  test.p_value = urban_nav_core::changeProbability(largest_, std::max(frames_, kHorizon));
  if (changes_.empty()) {
    test.sentence = "Disparities agree with those predicted from earlier frames in " + std::to_string(frames_) +
                    " frames: neither stereo camera has moved relative to the other.";
    test.remedy = kRemedy;
    return test;
  }
  if (std::any_of(changes_.begin(), changes_.end(), [](const Change& change) { return change.is_corrected; }))
    test.p_value = std::min(test.p_value, kTurnProbability);
  test.is_corrected = allCorrected();
  const auto duration = [](const Change& change) { return change.corrected_at - change.stamp; };
  const Change& decisive =
      test.is_corrected
          ? *std::max_element(changes_.begin(), changes_.end(),
                              [&](const Change& a, const Change& b) { return duration(a) < duration(b); })
          : *std::find_if(changes_.begin(), changes_.end(), [](const Change& change) { return !change.is_corrected; });
  test.interval = {decisive.stamp, test.is_corrected ? decisive.corrected_at : last_};
  test.sentence = "The disparity offset of the stereo pair changed";
  for (const Change& change : changes_) test.sentence += (&change == &changes_.front() ? " " : "; ") + describe(change);
  test.sentence += ": a camera has moved.";
  test.remedy = test.is_corrected ? kCorrectedRemedy : kRemedy;
  return test;
}

std::vector<ConstantSegment> OffsetMonitor::segments() const {
  if (frames_ < 2) return {};
  std::vector<ConstantSegment> segments{{"disparity_offset_px", {first_, last_}, 0.0, 0.0}};
  double variance = 0.0;
  for (const Change& change : changes_) {
    segments.back().interval.to = change.stamp;
    variance += change.sigma_px * change.sigma_px;
    segments.push_back(
        {"disparity_offset_px", {change.stamp, last_}, segments.back().value + change.px, std::sqrt(variance)});
  }
  return segments;
}

}  // namespace urban_nav_trust
