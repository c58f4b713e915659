// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_ros {

constexpr double kShortestBaseline = 0.01, kLongestBaseline = 3.0;  ///< m, of cameras on one vehicle

/// Returns the fault of an implausible baseline (m), with its remedy on a robot; empty for a plausible one.
std::string describeBaseline(double baseline);

}  // namespace urban_nav_ros
