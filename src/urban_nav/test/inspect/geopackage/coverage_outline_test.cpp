// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/geopackage/coverage_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace urban_nav {
namespace {

double ringArea(const Geometry::Ring& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += 0.5 * (a.x() * b.y() - b.x() * a.y());
  }
  return sum;
}

/// The area of all polygons with their holes, which are checked to run clockwise.
double polygonArea(const Coverage& coverage) {
  double area = 0.0;
  for (const Geometry::Polygon& polygon : coverage.polygons)
    for (std::size_t ring = 0; ring < polygon.size(); ++ring) {
      EXPECT_EQ(ringArea(polygon[ring]) > 0.0, ring == 0);
      area += ringArea(polygon[ring]);
    }
  return area;
}

TEST(CoverageOutline, OfAPointIsADisc) {
  const Coverage coverage = coverageAround({{0.3, -0.2}}, 5.0, 0.25);
  ASSERT_EQ(coverage.polygons.size(), 1U);
  EXPECT_EQ(coverage.polygons.front().size(), 1U);
  EXPECT_NEAR(coverage.area_m2, M_PI * 25.0, 1.0);
  EXPECT_NEAR(polygonArea(coverage), coverage.area_m2, 1e-9);
}

TEST(CoverageOutline, OfALoopHasAHole) {
  std::vector<Eigen::Vector2d> loop;
  for (int i = 0; i < 400; ++i) loop.emplace_back(20.0 * std::cos(i * M_PI / 200.0), 20.0 * std::sin(i * M_PI / 200.0));
  const Coverage coverage = coverageAround(loop, 5.0, 1.0);
  ASSERT_EQ(coverage.polygons.size(), 1U);
  EXPECT_EQ(coverage.polygons.front().size(), 2U);
  EXPECT_NEAR(coverage.area_m2, M_PI * (625.0 - 225.0), 30.0);
  EXPECT_NEAR(polygonArea(coverage), coverage.area_m2, 1e-9);
}

TEST(CoverageOutline, OfScatteredPointsKeepsItsAreaWhereCellsTouchAtCorners) {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < 120; ++i) {
      const auto x = static_cast<double>(random() % 14), y = static_cast<double>(random() % 14);
      points.emplace_back(0.5 + x, 0.5 + y);
    }
    const Coverage coverage = coverageAround(points, 0.4, 1.0);
    EXPECT_NEAR(polygonArea(coverage), coverage.area_m2, 1e-9) << round;
    for (const Geometry::Polygon& polygon : coverage.polygons)
      for (const Geometry::Ring& ring : polygon)
        for (std::size_t i = 0; i < ring.size(); ++i)
          for (std::size_t k = i + 1; k < ring.size(); ++k) EXPECT_NE(ring[i], ring[k]) << "a ring touches itself";
  }
}

TEST(CoverageOutline, OfNothingIsEmpty) { EXPECT_TRUE(coverageAround({}, 5.0, 1.0).polygons.empty()); }

}  // namespace
}  // namespace urban_nav
