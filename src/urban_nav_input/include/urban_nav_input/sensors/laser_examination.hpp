// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/laser/scan_check.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Counts defects of the scans of one laser. Not thread-safe.
class LaserExamination {
 public:
  /// `role`: "laser_left", "laser_right", "laser0" ..., as in `input.laser_left_delay`. `convention`: for reading its
  /// messages.
  LaserExamination(std::string role, std::string topic, const urban_nav_core::LaserConvention& convention)
      : role_(std::move(role)), topic_(std::move(topic)), convention_(convention) {}

  /// Returns the scan of a message; nullopt, and counted, if the directions of its beams are unknown.
  std::optional<urban_nav_core::PlanarScan> read(const sensor_msgs::LaserScan& message);
  const std::string& role() const { return role_; }
  std::vector<Finding> findings() const;
  void archive(urban_nav_core::Archive& archive) {
    archive(scans_, used_, no_stamp_, not_finite_, no_limit_, no_time_, unit_scans_, unit_fault_, unit_value_,
            unit_repair_, no_limit_value_, beams_, valid_, repeated_, last_, other_end_, stated_span_, made_span_,
            no_increment_, completed_, first_stamp_, last_stamp_, turn_s_);
  }

 private:
  Finding unitFinding() const;
  std::optional<Finding> turnFinding() const;
  std::string share(std::int64_t count) const;

  std::string role_, topic_;
  urban_nav_core::LaserConvention convention_;
  std::int64_t scans_ = 0, used_ = 0;
  std::int64_t no_stamp_ = 0, not_finite_ = 0;    // scans without a stamp, with angles that are not known
  std::int64_t no_limit_ = 0, no_time_ = 0;       // scans without a usable range_max, without a finite scan_time
  std::int64_t unit_scans_ = 0, unit_fault_ = 0;  // in other units; the ScanFault of the first of them
  double unit_value_ = 0.0, unit_repair_ = 1.0, no_limit_value_ = 0.0;  // values in the first of them
  std::int64_t beams_ = 0, valid_ = 0;
  std::int64_t repeated_ = 0, last_ = 0;  // scans with all ranges of the one before; checksum of the last ones
  std::int64_t other_end_ = 0;            // scans whose beams do not end at angle_max
  double stated_span_ = 0.0,
         made_span_ = 0.0;  // rad: angle_max - angle_min, and that of the beams, of the last of them
  std::int64_t no_increment_ = 0, completed_ = 0;  // scans without a finite time_increment, without one of the angles
  urban_nav_core::StampNs first_stamp_ = 0, last_stamp_ = 0;  // scans that are used
  double turn_s_ = 0.0;                                       // s, from the first to the last beam of the last scan
};

}  // namespace urban_nav_input
