// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/laser_examination.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_ros/laser_scan.hpp"

namespace urban_nav_input {

using urban_nav_core::formatNumber;
using urban_nav_core::ScanFault;

namespace {

constexpr std::int64_t kFewScans = 20;
constexpr double kFewValid = 0.02;  // share of beams: outdoors a third may see nothing
constexpr double kDegrees = 180.0 / M_PI;

bool hasUsableAngles(const sensor_msgs::LaserScan& message) {
  return std::isfinite(message.angle_min) && std::isfinite(message.angle_increment) &&
         std::isfinite(message.time_increment);
}

}  // namespace

std::optional<urban_nav_core::PlanarScan> LaserExamination::read(const sensor_msgs::LaserScan& message) {
  ++scans_;
  if (message.header.stamp.isZero()) ++no_stamp_;
  else if (!hasUsableAngles(message)) ++not_finite_;
  if (urban_nav_ros::hasNoRangeLimit(message) && no_limit_++ == 0)
    no_limit_value_ = std::isfinite(message.range_max) ? static_cast<double>(message.range_max) : -1.0;
  if (!std::isfinite(message.scan_time)) ++no_time_;
  const urban_nav_core::ScanVerdict verdict = urban_nav_ros::checkUnits(message, convention_);
  if (verdict.fault != ScanFault::None && unit_scans_++ == 0) {
    unit_fault_ = static_cast<std::int64_t>(verdict.fault);
    unit_value_ = verdict.value;
    unit_repair_ = verdict.repair;
  }
  std::optional<urban_nav_core::PlanarScan> scan = urban_nav_ros::toPlanarScan(message, convention_);
  beams_ += static_cast<std::int64_t>(message.ranges.size());
  if (!scan) return scan;
  ++used_;
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
  Finding finding{FindingKind::Lasers, "", ""};
  const bool is_angle = unit_fault_ == static_cast<std::int64_t>(ScanFault::AngleUnit);
  const double present = is_angle ? convention_.angle_scale : convention_.range_scale;
  if (is_angle)
    finding.text = topic_ + ": the beams of " + share(unit_scans_) + " span " + formatNumber(unit_value_, 4) +
                   " rad, more than a turn (2 pi)" + (unit_repair_ != 1.0 ? ": the angles are in degrees" : "");
  else
    finding.text = topic_ + ": the median range of " + share(unit_scans_) + " is " + formatNumber(unit_value_, 4) +
                   " m" +
                   (unit_repair_ == 0.001  ? ": the ranges are in millimetres"
                    : unit_repair_ == 0.01 ? ": the ranges are in centimetres"
                                           : ", farther than any planar laser measures");
  finding.text += "; these scans are not used";
  if (unit_repair_ == 1.0) {
    finding.remedy = "check the driver of this laser";
    return finding;
  }
  finding.options = {"--set", "input." + role_ + (is_angle ? "_angle_scale=" : "_range_scale=") +
                                  urban_nav_core::printNumber(unit_repair_ * present)};
  finding.remedy = finding.options[0] + " " + finding.options[1] + "; for later recordings let the driver publish " +
                   (is_angle ? "radians" : "metres");
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
    findings.push_back({FindingKind::Lasers,
                        topic_ + ": " + share(not_finite_) +
                            " have angles or time_increment that are not finite (NaN) and are not used",
                        "check the driver of this laser"});
  if (no_limit_ > 0)
    findings.push_back(
        {FindingKind::Lasers,
         topic_ + ": range_max of " + share(no_limit_) + " is " +
             (no_limit_value_ < 0.0 ? "not finite or negative" : formatNumber(no_limit_value_, 3) + " m") +
             ", which leaves no range; all ranges are used",
         "nothing has to be done; for later recordings set range_max in the driver"});
  if (no_time_ > 0)
    findings.push_back({FindingKind::Lasers,
                        topic_ + ": scan_time of " + share(no_time_) + " is not finite (NaN); it is not needed",
                        "nothing has to be done; for later recordings set scan_time in the driver"});
  if (used_ >= kFewScans && static_cast<double>(valid_) < kFewValid * static_cast<double>(beams_))
    findings.push_back({FindingKind::Lasers,
                        topic_ + ": " +
                            formatNumber(100.0 * static_cast<double>(valid_) / static_cast<double>(beams_), 3) +
                            " % of the beams have a finite range within range_min ... range_max",
                        "check range_min and range_max of the driver, and whether the laser is covered"});
  return findings;
}

}  // namespace urban_nav_input
