// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/offset_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_trust {

using urban_nav_core::formatNumber;
using urban_nav_core::StampNs;

namespace {

constexpr std::int64_t kHorizon = 20 * 3600;  // frames per hour: the alarm is set for sessions of that length
// Consecutive frames measure the same landmarks: the sum of n steps has this many times the variance of n independent
// ones (docs/derivations/trust.md).
constexpr double kSharedLandmarks = 3.0;
constexpr double kStepFloor = 0.02;          // px, error common to all landmarks of a frame: templates, rectification
constexpr StampNs kRenewal = 3'000'000'000;  // ns, until all landmarks were created with the new mounting

}  // namespace

OffsetMonitor::OffsetMonitor(const Parameters& parameters)
    : false_alarm_(parameters.false_alarm), detector_(false_alarm_, kHorizon) {}

bool OffsetMonitor::add(StampNs stamp, double step_px, double sigma_px) {
  if (!any_frame_) first_ = last_ = stamp;
  any_frame_ = true;
  if (!std::isfinite(step_px) || !(sigma_px > 0.0) || !std::isfinite(sigma_px)) return false;
  ++frames_;
  const Interval interval{last_, stamp};
  last_ = stamp;
  if (stamp < quiet_until_) return false;
  const bool alarm = detector_.add({interval, step_px, std::sqrt(kSharedLandmarks) * std::hypot(sigma_px, kStepFloor)});
  largest_ = std::max(largest_, detector_.statistic());
  if (!alarm) return false;
  const std::vector<urban_nav_core::ChangeDetector::Segment> segments = detector_.segments();
  const urban_nav_core::ChangeDetector::Segment &before = segments[segments.size() - 2], &after = segments.back();
  changes_.push_back({after.interval.from, after.mean - before.mean, std::hypot(before.sigma, after.sigma)});
  detector_ = urban_nav_core::ChangeDetector(false_alarm_, kHorizon);
  quiet_until_ = stamp + kRenewal;
  return true;
}

std::optional<ConsistencyTest> OffsetMonitor::test() const {
  if (frames_ < 2) return std::nullopt;
  ConsistencyTest test;
  test.name = kOffsetTest;
  test.interval = {changes_.empty() ? first_ : changes_.front().stamp, last_};
  test.statistic = largest_;
  test.degrees_of_freedom = static_cast<double>(frames_);
  test.p_value = urban_nav_core::changeProbability(largest_, std::max(frames_, kHorizon));
  test.remedy =
      "A camera of the stereo pair, left or right, was turned or moved against the other: fix its mount and calibrate "
      "the pair. Odometry corrects later images for a turn (swf_vo.right_turn_yaw_deg of summary.json); where "
      "it found none, lengths measured since then are wrong.";
  if (changes_.empty()) {
    test.sentence = "Disparities agree with those predicted from earlier frames in " + std::to_string(frames_) +
                    " frames: the stereo cameras keep their mounting.";
    return test;
  }
  test.sentence = "The disparity offset of the stereo pair changed";
  for (const Change& change : changes_)
    test.sentence += std::string(&change == &changes_.front() ? " by " : ", by ") + formatNumber(change.px) +
                     " px (+-" + formatNumber(change.sigma_px, 2) + ") at " +
                     formatNumber(urban_nav_core::secondsBetween(first_, change.stamp), 4) + " s";
  test.sentence += ": a camera has moved.";
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
