// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/baseline_check.hpp"

#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_ros {

std::string describeBaseline(double baseline) {
  if (baseline >= kShortestBaseline && baseline <= kLongestBaseline) return {};
  return "the baseline of the stereo camera is " + urban_nav_core::formatNumber(baseline, 4) +
         " m: P[3] of the right camera_info is -fx times the baseline in metres; correct the calibration file of its "
         "driver";
}

}  // namespace urban_nav_ros
