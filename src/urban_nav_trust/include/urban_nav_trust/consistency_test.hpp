// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/types/interval.hpp"

namespace urban_nav_trust {

using urban_nav_core::Interval;

/// Comparison of two independent measurements of one quantity.
struct ConsistencyTest {
  std::string name;   ///< "disparity_offset"; the same in files, messages and reports
  Interval interval;  ///< in which the measurements differ if the test fails; else the interval tested
  double statistic = 0.0;
  double degrees_of_freedom = 0.0;
  double p_value = 1.0;  ///< probability of at least this statistic if both measurements are right; 0...1
  std::string sentence;  ///< finding, with numbers and units
  std::string remedy;    ///< for the user; also set if the test passes
  /// The test fails, but its cause was measured: results are corrected from the end of `interval` on.
  bool is_corrected = false;
  /// A failure makes the position uncertain. False: it concerns only the map by lasers.
  bool affects_position = true;
};

/// Test that was not possible, with the reason.
struct AbsentMeasurement {
  std::string name;    ///< name of the test
  std::string reason;  ///< "no lasers"
};

/// Value of a constant of the rig over an interval.
struct ConstantSegment {
  std::string constant;  ///< "disparity_offset_px"
  Interval interval;
  double value = 0.0, sigma = 0.0;
};

}  // namespace urban_nav_trust
