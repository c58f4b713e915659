// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/layers/terrain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {
namespace {

constexpr int kSide = 41;

/// Returns the raster of a surface; `height`: of the middle of a cell.
Raster surface(const std::function<double(double x, double y)>& height, double cell = 0.1) {
  Raster raster;
  raster.width = raster.height = kSide;
  raster.cell = cell;
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u)
      raster.values.push_back(static_cast<float>(height((u + 0.5) * cell, (v + 0.5) * cell)));
  return raster;
}

TEST(Terrain, APlaneHasItsSlopeAndNoRoughness) {
  for (const double degrees : {0.0, 5.0, 15.0, 40.0})
    for (const double direction : {0.0, 0.4, 2.0}) {
      const double rise = std::tan(degrees * M_PI / 180.0);
      const TerrainLayers layers = terrainLayers(
          surface([&](double x, double y) { return 3.0 + rise * (std::cos(direction) * x + std::sin(direction) * y); }),
          {});
      const std::size_t middle = layers.slope.at(20, 20), corner = layers.slope.at(0, 0);
      EXPECT_NEAR(layers.slope.values[middle], degrees, 1e-3);
      EXPECT_NEAR(layers.slope.values[corner], degrees, 1e-3);
      EXPECT_NEAR(layers.roughness.values[middle], 0.0, 1e-5);
      const double step = 0.1 * rise * std::max(std::abs(std::cos(direction)), std::abs(std::sin(direction)));
      EXPECT_NEAR(layers.step.values[middle], step, 1e-5);
      const double expected = degrees < 20.0 ? 1.0 - (degrees / 20.0 + step / 0.12) / 3.0 : 0.0;
      EXPECT_NEAR(layers.traversability.values[middle], expected, 1e-3);
    }
}

TEST(Terrain, AStepIsMeasuredWithinTheRadiusAndBlocksAtItsLimit) {
  for (const double height : {0.03, 0.2}) {
    const TerrainLayers layers = terrainLayers(surface([&](double x, double) { return x < 2.0 ? 0.0 : height; }), {});
    for (int u = 0; u < kSide; ++u) {
      const double distance = std::min(std::abs((u + 0.5) * 0.1 - 1.95), std::abs((u + 0.5) * 0.1 - 2.05));
      const std::size_t i = layers.step.at(u, 20);
      EXPECT_NEAR(layers.step.values[i], distance < 0.351 ? height : 0.0, 1e-6) << u;
      if (distance > 0.351) EXPECT_EQ(layers.traversability.values[i], 1.0F) << u;
      else if (height > 0.12) EXPECT_EQ(layers.traversability.values[i], 0.0F) << u;
      else EXPECT_GT(layers.traversability.values[i], 0.0F) << u;
    }
  }
}

TEST(Terrain, RoughnessIsTheSpreadOfTheHeights) {
  const TerrainLayers layers =
      terrainLayers(surface([](double x, double y) {
                      return (std::lround(x / 0.1 - 0.5) + std::lround(y / 0.1 - 0.5)) % 2 == 0 ? 0.01 : -0.01;
                    }),
                    {});
  const float roughness = layers.roughness.values[layers.roughness.at(20, 20)];
  EXPECT_NEAR(roughness, 0.0103, 3e-4) << "of 37 heights, less three unknowns";
  EXPECT_NEAR(layers.slope.values[layers.slope.at(20, 20)], 0.0, 1e-3);
}

TEST(Terrain, NothingIsKnownWhereTooFewHeightsAre) {
  Raster raster = emptyLike(surface([](double, double) { return 0.0; }));
  for (int u = 0; u < kSide; ++u) raster.values[raster.at(u, 10)] = 1.0F;  // a line
  const TerrainLayers layers = terrainLayers(raster, {});
  for (const Raster* layer : {&layers.slope, &layers.step, &layers.roughness, &layers.traversability})
    for (const float value : layer->values) ASSERT_EQ(value, kNoValue);
}

TEST(Terrain, RastersInProjectedCoordinatesHaveTheSameSlope) {
  const double scale = 1.6;  // Mercator at 51 deg
  const auto layers = terrainLayers(surface([&](double x, double) { return 0.2 * x / scale; }, 0.1 * scale), {}, scale);
  EXPECT_NEAR(layers.slope.values[layers.slope.at(20, 20)], std::atan(0.2) * 180.0 / M_PI, 1e-3);
}

TEST(Terrain, DoesNotDependOnTheNumberOfThreads) {
  const Raster raster = surface([](double x, double y) { return 0.1 * std::sin(7.0 * x) * std::cos(5.0 * y); });
  const auto computed = [&](int threads) {
    const urban_nav_core::ThreadLimit limit(threads);
    return terrainLayers(raster, {}).traversability.values;
  };
  EXPECT_EQ(computed(1), computed(2));
}

TEST(Raster, IsCroppedToWhatIsKnown) {
  Raster raster = emptyLike(surface([](double, double) { return 0.0; }));
  raster.x0 = -7.0;
  raster.values[raster.at(5, 8)] = 1.0F;
  raster.values[raster.at(9, 10)] = 2.0F;
  const Raster part = cropped(raster);
  EXPECT_EQ(part.width, 5);
  EXPECT_EQ(part.height, 3);
  EXPECT_NEAR(part.x0, -6.5, 1e-12);
  EXPECT_NEAR(part.y0, 0.8, 1e-12);
  EXPECT_EQ(part.values[part.at(0, 0)], 1.0F);
  EXPECT_EQ(part.values[part.at(4, 2)], 2.0F);
  EXPECT_EQ(cropped(raster, 100).values, raster.values);
  EXPECT_EQ(cropped(emptyLike(raster)).values, std::vector<float>{kNoValue});
}

}  // namespace
}  // namespace laser_mapper
