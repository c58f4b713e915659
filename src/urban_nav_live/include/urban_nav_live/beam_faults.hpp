// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace urban_nav_live {

/// Counts beams of planar lasers whose range is NaN, a failed measurement (REP 117). Infinite ranges are not counted:
/// nothing was within range. Not thread-safe.
class BeamFaults {
 public:
  void add(const urban_nav_core::PlanarScan& scan) {
    beams_ += static_cast<std::int64_t>(scan.ranges.size());
    for (const float range : scan.ranges) not_numbers_ += std::isnan(range) ? 1 : 0;
  }
  void addTo(StageReport& report) const {
    report.fault_counts.push_back(
        {"laser ranges were not numbers", not_numbers_, beams_, "check the laser, its window and its driver"});
  }

 private:
  std::int64_t beams_ = 0, not_numbers_ = 0;
};

}  // namespace urban_nav_live
