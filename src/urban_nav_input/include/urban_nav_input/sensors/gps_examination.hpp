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

/// Counts defects of the fixes of a GPS receiver. Not thread-safe.
class GpsExamination {
 public:
  void add(const sensor_msgs::NavSatFix& fix);
  std::vector<Finding> findings(const std::string& topic) const;
  void archive(urban_nav_core::Archive& archive) {
    archive(messages_, no_fix_, at_zero_, no_angles_, no_altitude_, no_stamp_, repeated_, jumps_, no_variance_, last_,
            last_stamp_);
  }

 private:
  std::int64_t messages_ = 0;
  std::int64_t no_fix_ = 0, at_zero_ = 0, no_angles_ = 0, no_altitude_ = 0, no_stamp_ = 0;
  std::int64_t repeated_ = 0;          // positions equal to the previous one
  std::int64_t jumps_ = 0;             // positions farther from the previous one than a vehicle can move
  std::int64_t no_variance_ = 0;       // zero covariance of a known type
  std::array<double, 3> last_ = {{}};  // latitude and longitude in deg, altitude in m; 0 where it is not finite
  double last_stamp_ = 0.0;            // s; 0: none
};

}  // namespace urban_nav_input
