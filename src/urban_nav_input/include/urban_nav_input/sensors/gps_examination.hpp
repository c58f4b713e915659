// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/NavSatFix.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Counts what is wrong with the fixes of a GPS receiver. Not thread-safe.
class GpsExamination {
 public:
  void add(const sensor_msgs::NavSatFix& fix);
  std::vector<Finding> findings(const std::string& topic) const;
  void archive(urban_nav_core::Archive& archive) {
    archive(messages_, no_fix_, at_zero_, no_angles_, no_altitude_, no_stamp_, repeated_, last_);
  }

 private:
  std::int64_t messages_ = 0;
  std::int64_t no_fix_ = 0, at_zero_ = 0, no_angles_ = 0, no_altitude_ = 0, no_stamp_ = 0;
  std::int64_t repeated_ = 0;          // positions with all digits of the one before
  std::array<double, 3> last_ = {{}};  // latitude and longitude in deg, altitude in m
};

}  // namespace urban_nav_input
