// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_sim::bench {

/// Scans of one laser in order of time, with 181 beams each. Ranges (m) that are not positive are error codes of the
/// device and omitted.
struct Turns {
  std::vector<std::vector<double>> ranges, intensities;
};

/// Reads the laser rows of a MOOS log compressed by xz (Smith et al. 2009). `side`: "LEFT" or "RIGHT". Requires the
/// program xz. Throws std::runtime_error without the log, or without scans.
Turns newCollegeTurns(const std::string& path, const std::string& side);

}  // namespace urban_nav_sim::bench
