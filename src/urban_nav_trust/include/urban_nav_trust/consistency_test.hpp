// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/types/interval.hpp"

namespace urban_nav_trust {

using urban_nav_core::Interval;

/// Comparison of two independent measurements of one quantity.
struct ConsistencyTest {
  std::string name;   ///< "disparity_offset"; the same in all files, messages and reports
  Interval interval;  ///< in which the measurements differ, if the test fails; else the time that it covers
  double statistic = 0.0;
  double degrees_of_freedom = 0.0;
  double p_value = 1.0;  ///< probability of such a statistic or a larger one, where both are right; 0...1
  std::string sentence;  ///< finding, with numbers and units
  std::string remedy;    ///< repair, for the user; also if it passed
};

/// An independent measurement that was not there, and why.
struct AbsentMeasurement {
  std::string name;    ///< test that needs it
  std::string reason;  ///< "no lasers"
};

/// Value of a constant of the rig over an interval.
struct ConstantSegment {
  std::string constant;  ///< "disparity_offset_px"
  Interval interval;
  double value = 0.0, sigma = 0.0;
};

}  // namespace urban_nav_trust
