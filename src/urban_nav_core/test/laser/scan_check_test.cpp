// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/scan_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace urban_nav_core {
namespace {

/// 190 deg by half degrees, between 2 and 12 m.
PlanarScan sound() {
  PlanarScan scan;
  scan.angle_first = -95.0 * M_PI / 180.0;
  scan.angle_step = 0.5 * M_PI / 180.0;
  scan.range_min = 0.1;
  scan.range_max = 80.0;
  for (int i = 0; i < 381; ++i) scan.ranges.push_back(2.0F + 10.0F * static_cast<float>(i) / 380.0F);
  return scan;
}

PlanarScan scaled(double range_scale, double angle_scale) {
  PlanarScan scan = sound();
  for (float& range : scan.ranges) range *= static_cast<float>(range_scale);
  scan.range_min *= range_scale;
  scan.range_max *= range_scale;
  scan.angle_first *= angle_scale;
  scan.angle_step *= angle_scale;
  return scan;
}

TEST(ScanCheck, FindsNothingInSoundScans) {
  EXPECT_EQ(checkUnits(sound()).fault, ScanFault::None);
  EXPECT_EQ(checkUnits(PlanarScan()).fault, ScanFault::None);
  PlanarScan turn = sound();
  turn.angle_step = 2.0 * M_PI / 380.0;
  EXPECT_EQ(checkUnits(turn).fault, ScanFault::None) << "a whole turn";
  PlanarScan clockwise = sound();
  clockwise.angle_step *= -1.0;
  EXPECT_EQ(checkUnits(clockwise).fault, ScanFault::None);
  PlanarScan empty = sound();
  empty.ranges.assign(381, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(checkUnits(empty).fault, ScanFault::None);
}

TEST(ScanCheck, DetectsAnglesInDegrees) {
  const ScanVerdict verdict = checkUnits(scaled(1.0, 180.0 / M_PI));
  EXPECT_EQ(verdict.fault, ScanFault::AngleUnit);
  EXPECT_NEAR(verdict.value, 190.0, 1e-6);
  EXPECT_NEAR(verdict.repair, M_PI / 180.0, 1e-12);
  EXPECT_EQ(checkUnits(scaled(1.0, 1e4)).repair, 1.0) << "no unit";
}

TEST(ScanCheck, DetectsMillimetresAndCentimetres) {
  EXPECT_EQ(checkUnits(scaled(1000.0, 1.0)).fault, ScanFault::RangeUnit);
  EXPECT_EQ(checkUnits(scaled(1000.0, 1.0)).repair, 0.001);
  EXPECT_EQ(checkUnits(scaled(100.0, 1.0)).repair, 0.01);
  PlanarScan close = scaled(100.0, 1.0);
  close.range_max = 80'000.0;
  EXPECT_EQ(checkUnits(close).repair, 0.001) << "in centimetres it would measure to 800 m";
  EXPECT_EQ(checkUnits(scaled(1e6, 1.0)).repair, 1.0) << "no unit";
  EXPECT_EQ(checkUnits(scaled(1.0 / 0.3048, 1.0)).fault, ScanFault::None) << "feet are plausible metres";
}

}  // namespace
}  // namespace urban_nav_core
