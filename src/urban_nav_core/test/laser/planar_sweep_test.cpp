// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/planar_sweep.hpp"

#include <gtest/gtest.h>

namespace urban_nav_core {
namespace {

PlanarScan turnAt(StampNs stamp) {
  PlanarScan scan;
  scan.stamp = stamp;
  scan.angle_step = 0.01;
  scan.time_step = 1e-4;
  scan.range_max = 30.0;
  scan.ranges.assign(201, 5.0F);
  scan.ranges[3] = 0.0F;
  return scan;
}

TEST(PlanarSweep, ItsReferenceIsTheMiddleOfTheScan) {
  PlanarSweepReader reader;
  const Sweep sweep = reader.read(turnAt(1'000'000'000));
  EXPECT_EQ(sweep.times, Sweep::Times::Measured);
  EXPECT_EQ(sweep.reference, 1'010'000'000);
  EXPECT_NEAR(sweep.duration, 0.02, 1e-12);
  ASSERT_EQ(sweep.beams.size(), 200U);
  EXPECT_EQ(sweep.beams.back().stamp, 1'020'000'000);
  PlanarScan backwards = turnAt(2'000'000'000);
  backwards.time_step = -1e-4;
  EXPECT_EQ(reader.read(backwards).reference, 1'990'000'000);
}

TEST(PlanarSweep, WithoutTimesItTakesThePeriodOrTheTimeBetweenScans) {
  for (const double time_step : {0.0, 0.01}) {  // none; two seconds for a turn
    PlanarSweepReader reader;
    PlanarScan scan = turnAt(1'000'000'000);
    scan.time_step = time_step;
    EXPECT_EQ(reader.read(scan).times, Sweep::Times::Unknown);
    scan.stamp += 200'000'000;
    const Sweep second = reader.read(scan);
    EXPECT_EQ(second.reference, scan.stamp);
    EXPECT_NEAR(second.duration, 0.2, 1e-12);
    for (const Beam& beam : second.beams) EXPECT_EQ(beam.stamp, second.reference);
    scan.period = 0.05;
    EXPECT_NEAR(reader.read(scan).duration, 0.05, 1e-12);
  }
}

TEST(PlanarSweep, ALaserIsHorizontalWithinTenDegreesAlsoUpsideDown) {
  const auto turned = [](double roll, double pitch) {
    return Pose(expSo3({roll, 0.0, 0.0}) * expSo3({0.0, pitch, 0.0}), Vector3d::Zero());
  };
  EXPECT_TRUE(isHorizontal(turned(0.0, 0.0)));
  EXPECT_TRUE(isHorizontal(turned(M_PI, 0.1)));
  EXPECT_FALSE(isHorizontal(turned(0.0, 0.19)));
  EXPECT_FALSE(isHorizontal(turned(M_PI / 2.0, 0.0)));
  EXPECT_NEAR(tiltOfLaser(turned(M_PI - 0.3, 0.0)), 0.3, 1e-12);
}

}  // namespace
}  // namespace urban_nav_core
