// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_ros {

constexpr double kShortestBaseline = 0.01, kLongestBaseline = 3.0;  ///< m, of cameras on one vehicle

/// Returns what is wrong with a baseline (m) that no vehicle has, with its remedy on a robot; empty where nothing is.
std::string describeBaseline(double baseline);

}  // namespace urban_nav_ros
