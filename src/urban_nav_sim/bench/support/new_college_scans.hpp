// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_sim::bench {

/// Turns of one laser in order of time; 181 beams each. No range (m) where it is not over zero: then the device gave an
/// error code.
struct Turns {
  std::vector<std::vector<double>> ranges, intensities;
};

/// The lasers' rows of a MOOS log packed by xz (Smith et al. 2009). `side`: "LEFT" or "RIGHT". Needs the program xz.
/// Throws std::runtime_error where there is no such log, or no turn in it.
Turns newCollegeTurns(const std::string& path, const std::string& side);

}  // namespace urban_nav_sim::bench
