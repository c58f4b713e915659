// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_trust/test_results.hpp"

namespace urban_nav_trust {

constexpr const char* kFixTest = "gps_position";

/// GPS fix and the position of its antenna by the map.
struct ComparedFix {
  urban_nav_core::StampNs stamp = 0;
  Eigen::Vector2d by_map = Eigen::Vector2d::Zero();      ///< x, y in the map, m
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of by_map as stated, m^2
  Eigen::Vector2d by_gps = Eigen::Vector2d::Zero();      ///< east, north relative to any point, m
  Eigen::Vector2d sigma = Eigen::Vector2d::Ones();       ///< m, east, north, as stated by the receiver
};

/// Knowledge about fixes and map.
struct FixCircumstances {
  double correlation = 180.0;  ///< s, correlation time of the errors of GPS
  bool is_level = true;        ///< the vertical of the map was measured by an accelerometer
};

/// Tests the shape of the path in the map against GPS fixes, which took no part in it, after a level motion that aligns
/// both. Errors of fixes are correlated: the session is divided into parts of at least twice the correlation time, but
/// at least three, and each part contributes one measurement: the median of three consecutive fixes, with the error of
/// a single one, where the path is furthest from the others. The sum of squares is then at most chi-square. Jumps from
/// fix to fix, which the path excludes, are errors of GPS (multipath): they enlarge its standard deviation, and the
/// sentence names them. Adds a test or an absent one. `fixes`: in order of time; any that is not finite, or without a
/// positive sigma, is ignored. Derivation: docs/derivations/trust.md.
void testFixes(const std::vector<ComparedFix>& fixes, const FixCircumstances& known, TestResults& results);

}  // namespace urban_nav_trust
