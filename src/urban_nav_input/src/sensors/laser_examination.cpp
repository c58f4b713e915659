// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/laser_examination.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/sensor_corrections.hpp"

namespace urban_nav_input {

using urban_nav_core::formatNumber;
using urban_nav_core::ScanFault;

namespace {

constexpr std::int64_t kFewScans = 20;
constexpr double kFewValid = 0.02;    // share of beams; outdoors a third may have no return
constexpr double kOtherEnd = 0.02;    // share of the span
constexpr double kLeastShare = 0.05;  // least duration of the beams relative to the interval of scans
constexpr double kDegrees = 180.0 / M_PI;

constexpr double kTooLong = 1.5;      // duration relative to the interval of scans: overlap with the next scan
constexpr double kLeastSweep = 0.02;  // s

bool statesAllAngles(const sensor_msgs::LaserScan& message) {
  return std::isfinite(message.angle_min) && std::isfinite(message.angle_increment) &&
         (message.angle_increment != 0.0F || message.ranges.size() < 2);
}

/// Returns a checksum of the ranges (FNV-1a, 32 bits).
std::int64_t checksum(const std::vector<float>& ranges) {
  std::uint32_t sum = 2166136261U;
  for (const float range : ranges) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &range, sizeof(bits));
    sum = (sum ^ bits) * 16777619U;
  }
  return sum;
}

/// Returns the angle from the first to the last beam, by their number and by the stated end, rad.
std::pair<double, double> spans(const sensor_msgs::LaserScan& message) {
  return {static_cast<double>(message.angle_increment) * (static_cast<double>(message.ranges.size()) - 1.0),
          static_cast<double>(message.angle_max) - static_cast<double>(message.angle_min)};
}

}  // namespace

std::optional<urban_nav_core::PlanarScan> LaserExamination::read(const sensor_msgs::LaserScan& message) {
  ++scans_;
  if (message.header.stamp.isZero()) ++no_stamp_;
  if (urban_nav_ros::hasNoRangeLimit(message) && no_limit_++ == 0)
    no_limit_value_ = std::isfinite(message.range_max) ? static_cast<double>(message.range_max) : -1.0;
  if (!std::isfinite(message.scan_time)) ++no_time_;
  if (!std::isfinite(message.time_increment)) ++no_increment_;
  const urban_nav_core::ScanVerdict verdict = urban_nav_ros::checkUnits(message, convention_);
  if (verdict.fault != ScanFault::None && unit_scans_++ == 0) {
    unit_fault_ = static_cast<std::int64_t>(verdict.fault);
    unit_value_ = verdict.value;
    unit_repair_ = verdict.repair;
  }
  std::optional<urban_nav_core::PlanarScan> scan = urban_nav_ros::toPlanarScan(message, convention_);
  if (!scan && verdict.fault == ScanFault::None && !message.header.stamp.isZero()) ++not_finite_;
  if (scan && !statesAllAngles(message)) ++completed_;
  beams_ += static_cast<std::int64_t>(message.ranges.size());
  const std::int64_t sum = checksum(message.ranges);
  repeated_ += scans_ > 1 && sum == last_ ? 1 : 0;
  last_ = sum;
  if (const auto [spanned, stated] = spans(message);
      message.ranges.size() > 1 && std::isfinite(stated) && std::isfinite(spanned) &&
      std::abs(spanned - stated) > std::max(kOtherEnd * std::abs(stated),
                                            3.0 * std::abs(spanned) / static_cast<double>(message.ranges.size()))) {
    ++other_end_;
    stated_span_ = stated, made_span_ = spanned;
  }
  if (!scan) return scan;
  ++used_;
  if (first_stamp_ == 0) first_stamp_ = scan->stamp;
  last_stamp_ = scan->stamp;
  turn_s_ = std::abs(scan->time_step) * (static_cast<double>(scan->ranges.size()) - 1.0);
  valid_ += std::count_if(scan->ranges.begin(), scan->ranges.end(), [&](float range) {
    return std::isfinite(range) && range > 0.0F && static_cast<double>(range) >= scan->range_min &&
           static_cast<double>(range) <= scan->range_max;
  });
  return scan;
}

std::string LaserExamination::share(std::int64_t count) const {
  return std::to_string(count) + " of " + std::to_string(scans_) + " scans";
}

Finding LaserExamination::unitFinding() const {
  const urban_nav_core::ScanVerdict verdict{static_cast<ScanFault>(unit_fault_), unit_value_, unit_repair_};
  Finding finding{FindingKind::Lasers,
                  topic_ + ": " + share(unit_scans_) + " are not used: " + urban_nav_ros::describeUnits(verdict),
                  "check the driver of this laser"};
  for (const auto& setting : urban_nav_ros::settingsFor(verdict, role_, convention_)) {
    finding.options = {"--set", "input." + setting.name + "=" + setting.value};
    finding.remedy = finding.options[0] + " " + finding.options[1] + "; for later recordings let the driver publish " +
                     (verdict.fault == ScanFault::AngleUnit ? "radians" : "metres");
  }
  return finding;
}

std::optional<Finding> LaserExamination::turnFinding() const {
  if (used_ < kFewScans || last_stamp_ <= first_stamp_ || turn_s_ < kLeastSweep) return std::nullopt;
  const double interval = 1e-9 * static_cast<double>(last_stamp_ - first_stamp_) / static_cast<double>(used_ - 1);
  if (turn_s_ <= kTooLong * interval) return std::nullopt;
  Finding finding{FindingKind::Lasers,
                  topic_ + ": by time_increment the beams of a scan take " + formatNumber(turn_s_, 4) +
                      " s, and a scan comes every " + formatNumber(interval, 3) + " s",
                  "let the driver set time_increment in seconds from beam to beam"};
  for (const double unit : {1e-3, 1e-6, 1e-9}) {
    if (turn_s_ * unit > interval || turn_s_ * unit < kLeastShare * interval) continue;
    finding.text += unit == 1e-3   ? ": it is in milliseconds"
                    : unit == 1e-6 ? ": it is in microseconds"
                                   : ": it is in nanoseconds";
    finding.options = {"--set",
                       "input." + role_ + "_time_scale=" + urban_nav_core::printNumber(unit * convention_.time_scale)};
    finding.remedy = finding.options[0] + " " + finding.options[1] + "; for later recordings " + finding.remedy;
    break;
  }
  if (finding.options.empty()) {
    finding.options = {"--set", "input." + role_ + "_time_scale=0"};
    finding.remedy = finding.options[0] + " " + finding.options[1] +
                     " gives all beams the stamp of their scan; for later recordings " + finding.remedy;
  }
  return finding;
}

std::vector<Finding> LaserExamination::findings() const {
  std::vector<Finding> findings;
  if (scans_ == 0) return findings;
  if (unit_scans_ > 0) findings.push_back(unitFinding());
  if (no_stamp_ > 0)
    findings.push_back({FindingKind::Stamps, topic_ + ": " + share(no_stamp_) + " have no stamp and are not used",
                        "let the driver of this laser stamp its scans"});
  if (not_finite_ > 0)
    findings.push_back(
        {FindingKind::Lasers,
         topic_ + ": " + share(not_finite_) + " have angles that are zero or not finite (NaN) and are not used",
         "check angle_min, angle_max and angle_increment of the driver of this laser"});
  if (completed_ > 0)
    findings.push_back({FindingKind::Lasers,
                        topic_ + ": angle_min or angle_increment of " + share(completed_) +
                            " is zero or not finite (NaN); it is taken from angle_max and the number of beams",
                        "no action needed; for later recordings set the angles in the driver"});
  if (no_limit_ > 0)
    findings.push_back(
        {FindingKind::Lasers,
         topic_ + ": range_max of " + share(no_limit_) + " is " +
             (no_limit_value_ < 0.0 ? "not finite or negative" : formatNumber(no_limit_value_, 3) + " m") +
             ", which leaves no range; all ranges are used",
         "no action needed; for later recordings set range_max in the driver"});
  if (no_time_ > 0)
    findings.push_back({FindingKind::Lasers,
                        topic_ + ": scan_time of " + share(no_time_) + " is not finite (NaN); it is not needed",
                        "no action needed; for later recordings set scan_time in the driver"});
  if (no_increment_ > 0)
    findings.push_back({FindingKind::Lasers,
                        topic_ + ": time_increment of " + share(no_increment_) +
                            " is not finite (NaN); the time from beam to beam is taken from scan_time",
                        "no action needed; for later recordings set time_increment in the driver"});
  if (std::optional<Finding> finding = turnFinding()) findings.push_back(*std::move(finding));
  if (other_end_ > 0)
    findings.push_back({FindingKind::Lasers,
                        topic_ + ": the beams of " + share(other_end_) + " span " + formatNumber(made_span_, 4) +
                            " rad by their number and angle_increment, and " + formatNumber(stated_span_, 4) +
                            " rad by angle_min and angle_max; angle_increment is used",
                        "check angle_increment, angle_min and angle_max of the driver"});
  if (scans_ >= kFewScans && 2 * repeated_ > scans_ && valid_ > 0)
    findings.push_back({FindingKind::Lasers,
                        topic_ + ": " + share(repeated_) + " repeat the ranges of the previous scan exactly: frozen",
                        "restart the driver of this laser, and publish each scan once"});
  if (used_ >= kFewScans && static_cast<double>(valid_) < kFewValid * static_cast<double>(beams_))
    findings.push_back({FindingKind::Lasers,
                        topic_ + ": " +
                            formatNumber(100.0 * static_cast<double>(valid_) / static_cast<double>(beams_), 3) +
                            " % of the beams have a finite range within range_min ... range_max",
                        "check range_min and range_max of the driver, and whether the laser is covered"});
  return findings;
}

}  // namespace urban_nav_input
