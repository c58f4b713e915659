// SPDX-License-Identifier: BSD-3-Clause
#include "examination/stamp_check.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;

namespace {

constexpr double kLowestRate = 3.0;      // Hz, of stereo pairs from a vehicle at walking speed
constexpr double kLongestPairGap = 1.0;  // s
constexpr double kGapIntervals = 5.0;    // median intervals without a pair
constexpr double kUnevenShare = 0.2;     // of intervals ...
constexpr double kUneven = 0.4;          // ... that differ from the median by this share of it

constexpr std::size_t kFewIntervals = 10;

struct Gap {
  StampNs after = 0;
  double seconds = 0.0;
};

Finding gapFinding(const std::vector<Gap>& gaps, double interval) {
  const Gap& longest =
      *std::max_element(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.seconds < b.seconds; });
  return {
      FindingKind::Rates,
      std::to_string(gaps.size()) + (gaps.size() == 1 ? " gap" : " gaps") + " between stereo pairs, the longest " +
          urban_nav_core::formatNumber(longest.seconds, 3) + " s after " + urban_nav_core::printStamp(longest.after) +
          " (median interval " + urban_nav_core::formatNumber(interval, 3) + " s)",
      "record to a faster disk or with a larger buffer (rosbag record -b 4096); after a gap the motion is predicted, "
      "and its covariance grows"};
}

}  // namespace

std::vector<Finding> checkStamps(const std::vector<StampNs>& stamps) {
  std::vector<Finding> findings;
  if (stamps.size() < 3) return findings;
  std::vector<double> intervals;
  std::int64_t backward = 0;
  StampNs first_backward = 0;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const double seconds = urban_nav_core::secondsBetween(stamps[i - 1], stamps[i]);
    if (seconds > 0.0) intervals.push_back(seconds);
    else if (backward++ == 0) first_backward = stamps[i];
  }
  if (backward > 0)
    findings.push_back({FindingKind::Stamps,
                        std::to_string(backward) + " stereo pairs have stamps that do not increase, the first at " +
                            urban_nav_core::printStamp(first_backward),
                        "sort the input by stamp; a clock that steps needs to be slewed (chrony) while recording"});
  if (intervals.empty()) return findings;
  std::vector<double> sorted = intervals;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  std::vector<Gap> gaps;
  std::int64_t uneven = 0;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const double seconds = urban_nav_core::secondsBetween(stamps[i - 1], stamps[i]);
    if (seconds > std::max(kGapIntervals * median, std::min(kLongestPairGap, 20.0 * median)))
      gaps.push_back({stamps[i - 1], seconds});
    uneven += seconds > 0.0 && seconds < kGapIntervals * median && std::abs(seconds / median - 1.0) > kUneven;
  }
  if (!gaps.empty()) findings.push_back(gapFinding(gaps, median));
  if (1.0 / median < kLowestRate)
    findings.push_back({FindingKind::Rates,
                        "stereo pairs come at " + urban_nav_core::formatNumber(1.0 / median, 3) + " Hz",
                        "record at 10 Hz or more: features are tracked from image to image"});
  if (intervals.size() >= kFewIntervals &&
      static_cast<double>(uneven) > kUnevenShare * static_cast<double>(intervals.size()))
    findings.push_back({FindingKind::Stamps,
                        std::to_string(uneven) + " of " + std::to_string(intervals.size()) +
                            " intervals between stereo pairs differ from the median of " +
                            urban_nav_core::formatNumber(median, 3) +
                            " s by more than 40 %: the stamps seem to be times of arrival",
                        "stamp images when they are exposed (trigger or driver), not when they arrive"});
  return findings;
}

std::vector<Finding> checkStreams(const std::vector<StreamInfo>& streams) {
  constexpr double kSlowestImu = 40.0;  // Hz
  constexpr std::int64_t kFew = 20;     // messages
  std::vector<Finding> findings;
  for (const StreamInfo& stream : streams) {
    const bool is_imu = stream.type == "sensor_msgs/Imu", is_laser = stream.type == "sensor_msgs/LaserScan";
    if ((!is_imu && !is_laser) || stream.messages < kFew) continue;
    if (is_imu && stream.rate_hz < kSlowestImu)
      findings.push_back({FindingKind::Rates,
                          stream.name + " comes at " + urban_nav_core::formatNumber(stream.rate_hz, 3) + " Hz",
                          "set the IMU to 100 Hz or more"});
    if (stream.longest_gap_s > kLongestPairGap && stream.longest_gap_s * stream.rate_hz > 10.0)
      findings.push_back({FindingKind::Rates,
                          stream.name + " has a gap of " + urban_nav_core::formatNumber(stream.longest_gap_s, 3) + " s",
                          "check the cable and the driver of this device, and the recording disk"});
  }
  return findings;
}

}  // namespace urban_nav_input
