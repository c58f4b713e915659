// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace urban_nav_core {
namespace {

PlanarScan someScan() {
  PlanarScan scan;
  scan.stamp = 1225719873501685000;
  scan.angle_first = -M_PI / 4;
  scan.angle_step = M_PI / 4;
  scan.time_step = 18.5e-6;
  scan.period = 13.3e-3;
  scan.range_min = 0.1;
  scan.range_max = 80.0;
  scan.ranges = {1.0F,
                 0.0F,
                 2.0F,
                 -6.0F,
                 std::numeric_limits<float>::quiet_NaN(),
                 81.0F,
                 0.05F,
                 std::numeric_limits<float>::infinity(),
                 80.0F};
  scan.intensities = {10, 0, 20, 0, 0, 30, 40, 50, 60};
  return scan;
}

TEST(Scan, HoldsTheValidBeamsEachAtItsTimeAndDirection) {
  const Scan scan = toScan(someScan());
  ASSERT_EQ(scan.beams.size(), 3U);
  EXPECT_EQ(scan.stamp, someScan().stamp);
  EXPECT_EQ(scan.beams[0].stamp, scan.stamp);
  EXPECT_EQ(scan.beams[1].stamp, scan.stamp + 37000);
  EXPECT_EQ(scan.beams[2].stamp, scan.stamp + 148000);
  EXPECT_TRUE(scan.beams[0].direction.isApprox(Eigen::Vector3f(1, -1, 0).normalized(), 1e-6F));
  EXPECT_TRUE(scan.beams[1].direction.isApprox(Eigen::Vector3f(1, 1, 0).normalized(), 1e-6F));
  EXPECT_EQ(scan.beams[1].range, 2.0F);
  EXPECT_EQ(scan.beams[1].intensity, 20.0F);
  EXPECT_EQ(scan.beams[2].range, 80.0F);
}

TEST(Scan, IntensitiesMayBeAbsent) {
  PlanarScan scan = someScan();
  scan.intensities.clear();
  EXPECT_EQ(toScan(scan).beams[0].intensity, 0.0F);
}

TEST(Scan, ComparesToATolerance) {
  const PlanarScan a = someScan();
  PlanarScan b = a;
  EXPECT_TRUE(isApprox(a, b, 0.0)) << "invalid returns are equal";
  EXPECT_TRUE(isApprox(toScan(a), toScan(b), 0.0));
  b.ranges[2] += 0.01F;
  EXPECT_FALSE(isApprox(a, b, 0.005));
  EXPECT_TRUE(isApprox(a, b, 0.02));
  EXPECT_FALSE(isApprox(toScan(a), toScan(b), 0.005));
  b = a;
  b.ranges[1] = 3.0F;
  EXPECT_FALSE(isApprox(a, b, 100.0));
  EXPECT_FALSE(isApprox(toScan(a), toScan(b), 100.0));
  b = a;
  b.stamp += 1;
  EXPECT_FALSE(isApprox(a, b, 100.0));
}

TEST(Scan, PrintsItself) {
  std::ostringstream out;
  out << toScan(someScan());
  EXPECT_EQ(out.str(), "1225719873.501685000 s: 3 beams");
  out.str("");
  out << someScan();
  EXPECT_EQ(out.str(), "1225719873.501685000 s: 9 beams from -0.785398 rad by 0.785398 rad, 3 valid");
}

}  // namespace
}  // namespace urban_nav_core
