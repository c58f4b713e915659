// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/scan_check.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace urban_nav_core {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kMostTurn = 2.0 * kPi * 1.02;  // rad: some drivers repeat the first beam
constexpr std::size_t kFewRanges = 10;
constexpr double kMostMedian = 150.0;  // m: implausible median
constexpr double kLeastRange = 0.2;    // m, least median
constexpr double kUsualRange = 1.0;    // m, typical least median around a robot
constexpr double kMostReach = 130.0;   // m, of planar lasers outdoors
constexpr double kNoReach = 2e5;       // in any unit: no limit stated

double medianRange(const PlanarScan& scan) {
  std::vector<float> valid;
  for (const float range : scan.ranges)
    if (std::isfinite(range) && range > 0.0F && static_cast<double>(range) >= scan.range_min &&
        static_cast<double>(range) <= scan.range_max)
      valid.push_back(range);
  if (valid.size() < kFewRanges) return 0.0;
  const auto middle = valid.begin() + static_cast<std::ptrdiff_t>(valid.size() / 2);
  std::nth_element(valid.begin(), middle, valid.end());
  return static_cast<double>(*middle);
}

/// Returns m per unit of ranges with this median; 1 if neither millimetres nor centimetres fit.
double findRangeUnit(double median, double range_max) {
  const double millimetres = 0.001 * median, centimetres = 0.01 * median;
  if (millimetres >= kMostReach) return 1.0;
  const bool reaches_too_far = range_max < kNoReach && 0.01 * range_max > kMostReach;
  if (millimetres < kUsualRange && centimetres < kMostReach && !reaches_too_far) return 0.01;
  return millimetres > kLeastRange ? 0.001 : 1.0;
}

}  // namespace

ScanVerdict checkUnits(const PlanarScan& scan) {
  const double span = std::abs(scan.angle_step) * static_cast<double>(std::max<std::size_t>(1, scan.ranges.size()) - 1);
  if (span > kMostTurn) return {ScanFault::AngleUnit, span, span * kPi / 180.0 <= kMostTurn ? kPi / 180.0 : 1.0};
  const double median = medianRange(scan);
  if (median <= kMostMedian) return {};
  return {ScanFault::RangeUnit, median, findRangeUnit(median, scan.range_max)};
}

}  // namespace urban_nav_core
