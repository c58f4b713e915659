// SPDX-License-Identifier: BSD-3-Clause
#include "clock/floor_slope.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "clock/lower_line.hpp"

namespace segway_drivers {
namespace {

constexpr double kFloorSlope = 100e-6, kFloorDuration = 60.0, kWidestDelay = 19e-3;

std::vector<ClockPoint> drawFloor(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> delay(0.0, kWidestDelay);
  std::vector<ClockPoint> points;
  for (int i = 0; i < count; ++i) {
    const double x = kFloorDuration * i / count;
    points.push_back({x, kFloorSlope * x + delay(random)});
  }
  return points;
}

double meanOfX(const std::vector<ClockPoint>& points) {
  double sum = 0.0;
  for (const ClockPoint& point : points) sum += point.x;
  return sum / static_cast<double>(points.size());
}

TEST(FloorSlope, MomentsAreThoseOfTheLikelihood) {
  const std::vector<ClockPoint> points = drawFloor(600, 1);
  const double mean_x = meanOfX(points), spacing = kWidestDelay / 600.0;
  const SlopeEstimate estimate = estimateFloorSlope(lowerHull(points.data(), points.size()), mean_x, spacing);
  double sum = 0.0, first = 0.0, second = 0.0;
  for (double b = -100e-6; b < 300e-6; b += 1e-8) {  // by the definition, over all points
    double height = 1e9;
    for (const ClockPoint& point : points) height = std::min(height, point.z - b * (point.x - mean_x));
    const double likelihood = std::exp((height - kFloorSlope * mean_x) / spacing), off = b - kFloorSlope;
    sum += likelihood;
    first += likelihood * off;
    second += likelihood * off * off;
  }
  const double mean = first / sum;
  EXPECT_NEAR(estimate.slope, kFloorSlope + mean, 1e-8);
  EXPECT_NEAR(estimate.sigma, std::sqrt(second / sum - mean * mean), 1e-8);
}

/// Errors over many floors: as large as stated, and smaller than those of the edge over the mean.
TEST(FloorSlope, IsAsExactAsItStatesAndBetterThanTheEdge) {
  constexpr int kTrials = 300, kCount = 600;
  double squares = 0.0, stated = 0.0, edge_squares = 0.0, errors = 0.0;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    const std::vector<ClockPoint> points = drawFloor(kCount, seed), hull = lowerHull(points.data(), points.size());
    const double mean_x = meanOfX(points);
    const SlopeEstimate estimate = estimateFloorSlope(hull, mean_x, kWidestDelay / kCount);
    std::size_t i = 1;
    while (i + 1 < hull.size() && hull[i].x < mean_x) ++i;
    const double edge = (hull[i].z - hull[i - 1].z) / (hull[i].x - hull[i - 1].x);
    errors += estimate.slope - kFloorSlope;
    squares += std::pow(estimate.slope - kFloorSlope, 2);
    stated += estimate.sigma * estimate.sigma;
    edge_squares += std::pow(edge - kFloorSlope, 2);
  }
  EXPECT_GT(squares, 0.7 * stated);
  EXPECT_LT(squares, 1.4 * stated);
  EXPECT_LT(squares, 0.7 * edge_squares);
  EXPECT_LT(std::abs(errors / kTrials), 4.0 * std::sqrt(stated) / kTrials) << "unbiased";
}

TEST(FloorSlope, PointsOnALineGiveIt) {
  const std::vector<ClockPoint> hull = {{0.0, 1e-3}, {10.0, 1.5e-3}};
  const SlopeEstimate estimate = estimateFloorSlope(hull, 5.0, 1e-9);
  EXPECT_NEAR(estimate.slope, 50e-6, 1e-12);
  EXPECT_LT(estimate.sigma, 1e-9);
  EXPECT_GT(estimate.sigma, 0.0);
}

TEST(FloorSlope, AMeanAtAPointOfTheHullIsNoDivisionByZero) {
  const std::vector<ClockPoint> hull = {{0.0, 1e-3}, {5.0, 0.0}, {10.0, 1e-3}};
  const SlopeEstimate estimate = estimateFloorSlope(hull, 5.0, 1e-5);
  EXPECT_NEAR(estimate.slope, 0.0, 1e-12);
  EXPECT_GT(estimate.sigma, 1e-4) << "every slope between the edges is as likely";
  EXPECT_LT(estimate.sigma, 2e-4);
}

}  // namespace
}  // namespace segway_drivers
