// SPDX-License-Identifier: BSD-3-Clause
#include "features/growing_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/yard.hpp"

namespace scene_labeler {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// One point of a yard in each cube of 0.1 m.
std::vector<Eigen::Vector3f> sparseYard(unsigned seed) {
  std::vector<Eigen::Vector3f> points;
  urban_nav_registration::CellTable table(1000);
  for (const Eigen::Vector3f& point : testing::makeYard(seed).scene.points)
    if (table.insert(urban_nav_registration::toKey(urban_nav_registration::toCell(point, 10.0F))) == points.size())
      points.push_back(point);
  return points;
}

constexpr float kCubeOfHeights = 0.2F;  // m: heights refer to past means of these cubes too

bool isHeight(const std::string& name) {
  for (const char* begin : {"over_", "highest_", "raised_"})
    if (name.rfind(begin, 0) == 0) return true;
  return name == "below_highest" || name == "column_extent";
}

/// Compares features, and returns the share of the heights that differ by more than a cube.
double compare(const FeatureTable& a, const FeatureTable& b) {
  EXPECT_EQ(a.names, b.names);
  EXPECT_EQ(a.values.size(), b.values.size());
  double different = 0.0, heights = 0.0;
  for (std::size_t i = 0; i < a.values.size() && !::testing::Test::HasFailure(); ++i) {
    const std::string& name = a.names[i % a.columns()];
    EXPECT_EQ(std::isnan(a.values[i]), std::isnan(b.values[i])) << name;
    if (std::isnan(a.values[i]) || name == "column_filled") continue;
    if (!isHeight(name)) {
      EXPECT_NEAR(a.values[i], b.values[i], 1e-3F) << name;
      continue;
    }
    heights += 1.0;
    different += std::abs(a.values[i] - b.values[i]) > kCubeOfHeights ? 1.0 : 0.0;
  }
  return different / heights;
}

FeatureTable measureAtOnce(const std::vector<Eigen::Vector3f>& points, FeatureSet set) {
  Scene scene;
  scene.points = points;
  return measureFeatures(scene, set);
}

TEST(GrowingCloud, HasTheFeaturesOfAllPointsAtOnceHoweverTheyWereAdded) {
  const std::vector<Eigen::Vector3f> points = sparseYard(3);
  for (const FeatureSet set : {FeatureSet::All, FeatureSet::Paper, FeatureSet::Cloud}) {
    GrowingCloud at_once, in_parts;
    at_once.add(points);
    for (std::size_t part = 0; part < 7; ++part) {
      std::vector<Eigen::Vector3f> some;
      for (std::size_t i = part; i < points.size(); i += 7) some.push_back(points[i]);
      in_parts.add(some);
    }
    EXPECT_EQ(in_parts.size(), at_once.size());
    EXPECT_LT(compare(in_parts.measure(points, set), at_once.measure(points, set)), 0.01);
    EXPECT_LT(compare(at_once.measure(points, set), measureAtOnce(points, set)), 0.1)
        << "columns of cubes by their middle, and not by their mean";
  }
}

TEST(GrowingCloud, ForgetsWhatIsFarAway) {
  const std::vector<Eigen::Vector3f> points = sparseYard(4);
  std::vector<Eigen::Vector3f> both = points;
  for (const Eigen::Vector3f& point : points) both.push_back(point + Eigen::Vector3f(100.0F, 0.0F, -5.0F));
  GrowingCloud cloud;
  cloud.add(both);
  const std::size_t all = cloud.size();
  cloud.keepAround({4.0F, 4.0F, 0.0F}, 20.0F);
  EXPECT_LT(cloud.size(), all * 6 / 10);
  GrowingCloud alone;
  alone.add(points);
  EXPECT_EQ(cloud.size(), alone.size());
  for (const FeatureSet set : {FeatureSet::All, FeatureSet::Cloud})
    EXPECT_LT(compare(cloud.measure(points, set), alone.measure(points, set)), 0.01);
}

TEST(GrowingCloud, IgnoresPointsWithoutAPlace) {
  GrowingCloud cloud;
  EXPECT_TRUE(std::isnan(cloud.measure({{1.0F, 2.0F, 3.0F}}, FeatureSet::All).values.front()));
  cloud.add({{kNan, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}, {1e7F, 0.0F, 0.0F}});
  EXPECT_EQ(cloud.size(), 1U);
  const FeatureTable table =
      cloud.measure({{kNan, 0.0F, 0.0F}, {1e7F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}}, FeatureSet::All);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < table.columns(); ++k) EXPECT_TRUE(std::isnan(table.row(i)[k]));
  EXPECT_FALSE(std::isnan(table.row(2)[8])) << "share of occupied cubes";
}

}  // namespace
}  // namespace scene_labeler
