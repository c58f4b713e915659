// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/cloud/planar_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sample_cloud.hpp"

namespace urban_nav_core {
namespace {

using testing::kBegin;
using testing::kPeriod;
using testing::SampleCloud;
using testing::SampleField;
using testing::SamplePoint;
using Number = CloudField::Number;

constexpr double kBeamStep = 0.5 * M_PI / 180.0;

double rangeAt(double angle) { return 6.0 + 2.0 * std::cos(3.0 * angle); }

/// Half a turn from -90 deg to 90 deg, or back; each `hole`-th beam has no return, and the driver leaves it out.
std::vector<SamplePoint> halfTurn(bool is_clockwise, int hole = 7) {
  std::vector<SamplePoint> points;
  for (int i = 0; i <= 360; ++i) {
    if (i % hole == 3) continue;
    SamplePoint point;
    point.column = i;
    point.share = i / 360.0;
    const double angle = (is_clockwise ? 1.0 : -1.0) * (M_PI_2 - kBeamStep * i);
    point.x = rangeAt(angle) * std::cos(angle);
    point.y = rangeAt(angle) * std::sin(angle);
    points.push_back(point);
  }
  return points;
}

std::vector<SampleField> fields(double time_unit, double height = 0.0) {
  return {{{"x", 0, Number::Float32, 1}, [](const auto& p, double, double) { return p.x; }},
          {{"y", 4, Number::Float32, 1}, [](const auto& p, double, double) { return p.y; }},
          {{"z", 8, Number::Float32, 1}, [height](const auto& p, double, double) { return p.z + height; }},
          {{"time", 12, Number::Float32, 1},
           [time_unit](const auto& p, double, double) { return 0.0066 * p.share / time_unit; }},
          {{"intensity", 16, Number::Float32, 1}, [](const auto& p, double, double) { return p.column % 100; }}};
}

std::optional<PlanarPattern> survey(const std::vector<SamplePoint>& points, const std::vector<SampleField>& layout) {
  PlanarCloudSurvey survey;
  for (int i = 0; i < 8; ++i) {
    SampleCloud cloud(points, layout, 20, kBegin + i * kPeriod, 0);
    survey.add(cloud.view());
  }
  return survey.conclude();
}

TEST(PlanarCloud, BeamsHaveTheirAnglesRangesAndTimes) {
  for (const bool is_clockwise : {false, true}) {
    for (const double unit : {1.0, 1e-3, 1e-6}) {
      const auto pattern = survey(halfTurn(is_clockwise), fields(unit));
      ASSERT_TRUE(pattern);
      EXPECT_NEAR(pattern->angle_step, kBeamStep, 1e-6);
      EXPECT_EQ(pattern->is_clockwise, is_clockwise);
      SampleCloud cloud(halfTurn(is_clockwise), fields(unit), 20, kBegin, 0);
      const auto planar = toPlanarScan(cloud.view(), *pattern);
      ASSERT_TRUE(planar);
      const Scan scan = toScan(*planar);
      EXPECT_EQ(scan.beams.size(), halfTurn(is_clockwise).size());
      for (const Beam& beam : scan.beams) {
        const double angle = std::atan2(beam.direction.y(), beam.direction.x());
        EXPECT_NEAR(beam.range, rangeAt(angle), 2e-3);
        const double share = is_clockwise ? (M_PI_2 - angle) / M_PI : (M_PI_2 + angle) / M_PI;
        EXPECT_NEAR(1e-9 * static_cast<double>(beam.stamp - kBegin), 0.0066 * share, 2e-6);
      }
    }
  }
}

TEST(PlanarCloud, WithoutTimesAllBeamsHaveTheStampOfTheCloud) {
  std::vector<SampleField> layout = fields(1.0);
  layout.erase(layout.begin() + 3);
  const auto pattern = survey(halfTurn(false), layout);
  ASSERT_TRUE(pattern);
  SampleCloud cloud(halfTurn(false), layout, 20, kBegin, 0);
  const auto scan = toPlanarScan(cloud.view(), *pattern);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->stamp, kBegin);
  EXPECT_EQ(scan->time_step, 0.0);
}

TEST(PlanarCloud, WhatIsNotInThePlaneOfTheFrameIsOfNoPlanarLaser) {
  EXPECT_FALSE(survey(testing::sampleTurn(), fields(1.0)));
  EXPECT_FALSE(survey(halfTurn(false), fields(1.0, 0.3)));
  EXPECT_FALSE(survey({}, fields(1.0)));
}

TEST(PlanarCloud, ScatteredPointsOfAPlaneAreNoBeams) {
  std::vector<SamplePoint> points;
  for (int i = 0; i < 300; ++i) {
    SamplePoint point;
    point.x = 10.0 * std::sin(12.9898 * i);
    point.y = 10.0 * std::sin(78.233 * i + 1.0);
    points.push_back(point);
  }
  EXPECT_FALSE(survey(points, fields(1.0)));
}

TEST(PlanarCloud, NumbersThatAreNotFiniteMakeNoBeam) {
  std::vector<SamplePoint> points = halfTurn(false);
  points[5].x = std::nan("");
  points[9].y = HUGE_VAL;
  points[11].share = std::nan("");
  const auto pattern = survey(halfTurn(false), fields(1.0));
  SampleCloud cloud(points, fields(1.0), 20, kBegin, 0);
  const auto scan = toPlanarScan(cloud.view(), *pattern);
  ASSERT_TRUE(scan);
  EXPECT_EQ(toScan(*scan).beams.size(), points.size() - 2);
  for (const Beam& beam : toScan(*scan).beams) EXPECT_TRUE(std::isfinite(beam.range) && beam.direction.allFinite());
  SampleCloud none({}, fields(1.0), 20, kBegin, 0);
  EXPECT_FALSE(toPlanarScan(none.view(), *pattern));
}

}  // namespace
}  // namespace urban_nav_core
