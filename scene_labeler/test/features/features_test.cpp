// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/features/features.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace scene_labeler {
namespace {

float featureAt(const FeatureTable& table, std::size_t row, const std::string& name) {
  const auto found = std::find(table.names.begin(), table.names.end(), name);
  EXPECT_NE(found, table.names.end()) << name;
  return table.row(row)[found - table.names.begin()];
}

/// Ground at z = 0, a plate 2 m above it in the middle, and a wall at x = 6.
Scene makeBox() {
  Scene scene;
  for (int i = 0; i <= 120; ++i)
    for (int j = 0; j <= 120; ++j) {
      const float a = 0.05F * static_cast<float>(i), b = 0.05F * static_cast<float>(j);
      scene.points.emplace_back(a, b, 0.0F);
      if (i > 40 && i < 80 && j > 40 && j < 80) scene.points.emplace_back(a, b, 2.0F);
      scene.points.emplace_back(6.0F, a, 0.5F * b);
    }
  return scene;
}

TEST(Features, OfPlanesAreTheirNormalsAndHeights) {
  const Scene scene = makeBox();
  const FeatureTable table = measureFeatures(scene, FeatureSet::All);
  ASSERT_EQ(table.rows(), scene.points.size());
  std::size_t ground = 0, plate = 0, wall = 0;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Eigen::Vector3f& p = scene.points[i];
    if (p.x() > 1 && p.x() < 1.6F && p.y() > 1 && p.y() < 1.6F && p.z() == 0) ground = i;
    if (p.z() == 2.0F && p.x() < 5.9F && std::abs(p.x() - 3) < 0.1F && std::abs(p.y() - 3) < 0.1F) plate = i;
    if (p.x() == 6.0F && std::abs(p.y() - 3) < 0.1F && std::abs(p.z() - 1.5F) < 0.1F) wall = i;
  }
  for (const std::size_t i : {ground, plate}) {
    EXPECT_NEAR(featureAt(table, i, "normal_z_0.4"), 1.0F, 1e-3F);
    EXPECT_NEAR(featureAt(table, i, "scatter_0.4"), 0.0F, 1e-3F);
    EXPECT_NEAR(featureAt(table, i, "linearity_0.4"), 0.0F, 0.15F);
  }
  EXPECT_NEAR(featureAt(table, wall, "normal_z_0.4"), 0.0F, 1e-3F);
  EXPECT_NEAR(featureAt(table, ground, "over_ground"), 0.0F, 1e-3F);
  EXPECT_NEAR(featureAt(table, plate, "over_ground"), 2.0F, 1e-3F);
  EXPECT_NEAR(featureAt(table, plate, "over_lowest_1"), 2.0F, 1e-3F);
  EXPECT_NEAR(featureAt(table, plate, "below_highest"), 0.0F, 1e-3F);
  EXPECT_NEAR(featureAt(table, wall, "over_ground"), 1.5F, 0.2F);
}

TEST(Features, DoNotDependOnTheDensityOfTheBeams) {
  Scene scene = makeBox();
  const FeatureTable once = measureFeatures(scene, FeatureSet::All);
  const std::size_t count = scene.points.size();
  for (std::size_t i = 0; i < count; i += 2)
    for (int copy = 0; copy < 3; ++copy) scene.points.push_back(scene.points[i]);
  const FeatureTable dense = measureFeatures(scene, FeatureSet::All);
  for (std::size_t i = 0; i < count; i += 97)
    EXPECT_NEAR(featureAt(once, i, "normal_z_0.4"), featureAt(dense, i, "normal_z_0.4"), 0.05F);
}

constexpr float kHeightTolerance = 0.2F;  // m: a height is that of the mean of its cube

/// A wall at y = 5 and the ground before it in horizontal lines `spacing` apart, as of the rings of a LiDAR.
Scene makeRings(float spacing) {
  Scene scene;
  for (float across = 0.0F; across < 5.0F; across += spacing)
    for (int i = 0; i < 200; ++i) {
      scene.points.emplace_back(0.05F * static_cast<float>(i), 5.0F, across);
      scene.points.emplace_back(0.05F * static_cast<float>(i), across, 0.0F);
    }
  return scene;
}

TEST(Features, OfCloudsAreThoseOfSurfacesHoweverFarApartTheRingsAre) {
  for (const float spacing : {0.05F, 0.3F, 0.7F}) {
    const Scene scene = makeRings(spacing);
    const FeatureTable table = measureFeatures(scene, FeatureSet::Cloud);
    std::size_t checked = 0;
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
      const Eigen::Vector3f& p = scene.points[i];
      const bool is_wall = p.y() == 5.0F;
      const float across = is_wall ? p.z() : p.y();
      if (p.x() < 3.0F || p.x() > 7.0F || across < 1.8F || across > 2.8F) continue;
      ++checked;
      ASSERT_NEAR(featureAt(table, i, "normal_z"), is_wall ? 0.0F : 1.0F, 0.02F) << spacing;
      ASSERT_NEAR(featureAt(table, i, "scatter"), 0.0F, 0.05F) << spacing;
      ASSERT_LT(featureAt(table, i, "linearity"), 0.75F) << spacing;
      ASSERT_NEAR(featureAt(table, i, "over_ground"), is_wall ? across : 0.0F, kHeightTolerance) << spacing;
    }
    EXPECT_GT(checked, 100U);
  }
}

TEST(Features, OfCloudsHaveAScaleThatGrowsWithTheSpacing) {
  const auto scaleAt = [](float spacing) {
    const Scene scene = makeRings(spacing);
    const FeatureTable table = measureFeatures(scene, FeatureSet::Cloud);
    for (std::size_t i = 0; i < scene.points.size(); ++i)
      if (scene.points[i].y() == 5.0F && scene.points[i].z() > 2.0F && scene.points[i].x() > 4.0F)
        return featureAt(table, i, "spacing");
    return -1.0F;
  };
  EXPECT_EQ(scaleAt(0.05F), 0.0F);
  EXPECT_LT(scaleAt(0.05F), scaleAt(0.3F));
  EXPECT_LT(scaleAt(0.3F), scaleAt(0.9F));
}

TEST(Features, OfCloudsShowWhatRisesAroundAReturn) {
  const Scene scene = makeBox();
  const FeatureTable table = measureFeatures(scene, FeatureSet::Cloud);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    const Eigen::Vector3f& p = scene.points[i];
    const bool is_under_plate = p.z() == 0.0F && (p - Eigen::Vector3f(3, 3, 0)).norm() < 0.05F;
    const bool is_corner = p.z() == 0.0F && p.head<2>().norm() < 0.05F;
    if (!is_under_plate && !is_corner) continue;
    EXPECT_NEAR(featureAt(table, i, "highest_1"), is_corner ? 0.0F : 2.0F, 1e-3F);
    EXPECT_NEAR(featureAt(table, i, "raised_1"), is_corner ? 0.0F : 1.0F, 0.2F) << "squares at the edge of the plate";
  }
}

TEST(Features, OfReturnsThatAreNotFiniteAreMissing) {
  Scene scene = makeBox();
  scene.points[7].x() = std::numeric_limits<float>::quiet_NaN();
  scene.points[9].z() = std::numeric_limits<float>::infinity();
  scene.reflectance.assign(scene.points.size(), 0.5F);
  for (const FeatureSet set : {FeatureSet::Paper, FeatureSet::All, FeatureSet::Cloud}) {
    const FeatureTable table = measureFeatures(scene, set);
    for (std::size_t column = 0; column < table.columns(); ++column) {
      EXPECT_TRUE(std::isnan(table.row(7)[column]));
      EXPECT_TRUE(std::isnan(table.row(9)[column]));
    }
    for (const float value : table.values) EXPECT_FALSE(std::isinf(value));
  }
}

TEST(Features, ReflectanceIsThatOfTheMaterialWhereTheSensorIsKnown) {
  Scene scene;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j)
      scene.points.emplace_back(0.05F * static_cast<float>(i), 2.0F + 0.2F * static_cast<float>(j), 0.0F);
  const Eigen::Vector3f sensor(1.5F, 0.0F, 1.0F);
  for (const Eigen::Vector3f& point : scene.points) {
    scene.to_sensor.push_back(sensor - point);
    const float range = scene.to_sensor.back().norm(), cosine = 1.0F / range;
    const float light = range / (range + 0.5F) * std::min(1.0F, 8.0F / range) * std::pow(std::max(cosine, 0.2F), 0.85F);
    scene.reflectance.push_back(120.0F * light);
  }
  const FeatureTable table = measureFeatures(scene, FeatureSet::All);
  for (std::size_t i = 0; i < table.rows(); i += 37) EXPECT_NEAR(featureAt(table, i, "reflectance"), 120.0F, 6.0F) << i;
  scene.to_sensor.clear();
  const FeatureTable plain = measureFeatures(scene, FeatureSet::All);
  EXPECT_FLOAT_EQ(featureAt(plain, 777, "reflectance"), scene.reflectance[777]);
}

/// A camera at the origin, looking along y, in front of a wall at y = 5: its left half is orange, its right half grey.
Scene makeFacade(const std::vector<Eigen::Vector3f>& others = {}) {
  Scene scene;
  scene.points = others;
  for (int i = -40; i <= 40; ++i)
    for (int j = -20; j <= 20; ++j)
      scene.points.emplace_back(0.1F * static_cast<float>(i), 5.0F, 0.1F * static_cast<float>(j));
  scene.view.image = cv::Mat(240, 320, CV_8UC3, cv::Scalar(30, 90, 180));
  scene.view.image.colRange(160, 320).setTo(cv::Scalar(120, 120, 120));
  Eigen::Matrix<double, 3, 4> projection;
  projection << 200, 160, 0, 0, 0, 120, -200, 0, 0, 1, 0, 0;
  projectScene(projection, scene);
  return scene;
}

TEST(Features, OfAnImageAreTheColoursWhereTheReturnsAre) {
  const Scene scene = makeFacade();
  const FeatureTable table = measureFeatures(scene, FeatureSet::All);
  const auto rowAt = [](int i, int j) { return static_cast<std::size_t>((i + 40) * 41 + j + 20); };
  EXPECT_NEAR(featureAt(table, rowAt(-20, 0), "light_7"), 300.0F / 765.0F, 1e-4F);
  EXPECT_NEAR(featureAt(table, rowAt(-20, 0), "red_7"), 0.6F, 1e-4F);
  EXPECT_NEAR(featureAt(table, rowAt(-20, 0), "saturation_21"), 150.0F / 180.0F, 1e-4F);
  EXPECT_NEAR(featureAt(table, rowAt(20, 0), "saturation_21"), 0.0F, 1e-4F);
  EXPECT_NEAR(featureAt(table, rowAt(20, 0), "gradient_across_7"), 0.0F, 1e-5F);
  EXPECT_GT(featureAt(table, rowAt(0, 0), "contrast_21"), 0.01F);
  const FeatureTable paper = measureFeatures(scene, FeatureSet::Paper);
  EXPECT_NEAR(featureAt(paper, rowAt(-20, 0), "hue_0"), 1.0F, 1e-5F);
  EXPECT_NEAR(featureAt(paper, rowAt(20, 0), "saturation_0"), 1.0F, 1e-5F);
}

TEST(Features, OfAnImageAreMissingWhereItIsSaturatedOrHidden) {
  Scene scene = makeFacade({{0.0F, 30.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, {0.0F, 4.0F, 0.0F}});
  EXPECT_EQ(scene.view.is_visible[0], 0) << "hidden by the wall";
  EXPECT_EQ(scene.view.is_visible[1], 0) << "after the camera";
  EXPECT_EQ(scene.view.is_visible[2], 1) << "before the wall";
  scene.view.image.setTo(cv::Scalar(255, 255, 255));
  const FeatureTable table = measureFeatures(scene, FeatureSet::All);
  for (std::size_t i = 0; i < table.rows(); i += 13) EXPECT_TRUE(std::isnan(featureAt(table, i, "light_7")));
}

TEST(Features, IgnoreTheReflectanceOfPointsThatHaveNone) {
  Scene scene = makeBox();
  scene.reflectance.assign(scene.points.size(), 80.0F);
  for (std::size_t i = 0; i < scene.points.size(); i += 3) scene.reflectance[i] = std::nanf("");
  const FeatureTable table = measureFeatures(scene, FeatureSet::All);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    ASSERT_EQ(std::isnan(featureAt(table, i, "reflectance")), i % 3 == 0);
    ASSERT_NEAR(featureAt(table, i, "reflectance_mean"), 80.0F, 1e-3F);
    ASSERT_NEAR(featureAt(table, i, "reflectance_deviation"), 0.0F, 0.1F);
  }
  scene.reflectance.assign(scene.points.size(), std::nanf(""));
  const FeatureTable without = measureFeatures(scene, FeatureSet::All);
  for (std::size_t i = 0; i < scene.points.size(); i += 100)
    ASSERT_TRUE(std::isnan(featureAt(without, i, "reflectance_mean")));
}

}  // namespace
}  // namespace scene_labeler
