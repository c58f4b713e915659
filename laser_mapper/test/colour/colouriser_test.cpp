// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/colour/colouriser.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "colour/depth_map_pool.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_registration::Picture;

constexpr int kTestWidth = 320, kTestHeight = 240;

/// A view from (x, 0, 0) along z.
ColourView viewFrom(double x, std::size_t image) {
  ColourView view;
  view.camera.pinhole = {200.0, 200.0, 160.0, 120.0, kTestWidth, kTestHeight};
  view.T_map_camera = Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0.0, 0.0));
  view.image = image;
  return view;
}

/// A wall at z = `depth`, 5 cm from point to point.
std::vector<MapPoint> wallAt(float depth, float low_x, float high_x) {
  std::vector<MapPoint> points;
  for (float x = low_x; x < high_x; x += 0.05F)
    for (float y = -1.0F; y < 1.0F; y += 0.05F) {
      MapPoint point;
      point.p = {x, y, depth};
      point.normal = -Eigen::Vector3f::UnitZ();
      points.push_back(point);
    }
  return points;
}

Picture uniform(std::uint8_t blue, std::uint8_t green, std::uint8_t red) {
  Picture picture{kTestWidth, kTestHeight, {}};
  for (int i = 0; i < kTestWidth * kTestHeight; ++i) picture.bgr.insert(picture.bgr.end(), {blue, green, red});
  return picture;
}

TEST(Colouriser, ExposuresAreEqualised) {
  std::vector<ColourView> views;
  for (std::size_t i = 0; i < 5; ++i) views.push_back(viewFrom(0.2 * static_cast<double>(i), i));
  const auto load = [](std::size_t image) {
    const double gain = 0.6 + 0.2 * static_cast<double>(image);
    return uniform(static_cast<std::uint8_t>(40.0 * gain), static_cast<std::uint8_t>(90.0 * gain),
                   static_cast<std::uint8_t>(140.0 * gain));
  };
  Colouriser colouriser(views, load, 0.05, ColourMemory{2});
  std::vector<MapPoint> wall = wallAt(3.0F, -1.0F, 1.5F);
  colouriser.addSurface(wall);
  colouriser.equalise();
  for (std::size_t i = 1; i < 5; ++i)
    EXPECT_NEAR(colouriser.gains()[0][2] / colouriser.gains()[i][2], (0.6 + 0.2 * static_cast<double>(i)) / 0.6, 0.03);
  EXPECT_EQ(colouriser.colour(wall), wall.size());
  for (const MapPoint& point : wall) {
    EXPECT_NEAR(point.blue, 40, 2);
    EXPECT_NEAR(point.green, 90, 3);
    EXPECT_NEAR(point.red, 140, 3);
  }
}

TEST(Colouriser, WhatIsHiddenIsNotColoured) {
  Colouriser colouriser(
      {viewFrom(0.0, 0)}, [](std::size_t) { return uniform(10, 20, 200); }, 0.05, ColourMemory{1});
  std::vector<MapPoint> far = wallAt(6.0F, -1.0F, 1.0F), near = wallAt(2.0F, -0.2F, 0.2F);
  colouriser.addSurface(far);
  colouriser.addSurface(near);
  colouriser.equalise();
  EXPECT_EQ(colouriser.colour(near), near.size());
  colouriser.colour(far);
  for (const MapPoint& point : far) {
    const bool hidden = std::abs(point.p.x() / 3.0F) < 0.2F && std::abs(point.p.y() / 3.0F) < 0.95F;
    if (hidden) {
      EXPECT_EQ(point.red, 0) << point.p.transpose();
    }
    if (std::abs(point.p.x() / 3.0F) > 0.35F) {
      EXPECT_EQ(point.red, 200) << point.p.transpose();
    }
  }
}

/// The ground 1.5 m below the camera, from z = `near` to `far`.
std::vector<MapPoint> groundFrom(float near, float far) {
  std::vector<MapPoint> points;
  for (float z = near; z < far; z += 0.05F)
    for (float x = -2.0F; x < 2.0F; x += 0.05F) {
      MapPoint point;
      point.p = {x, 1.5F, z};
      point.normal = -Eigen::Vector3f::UnitY();
      points.push_back(point);
    }
  return points;
}

TEST(Colouriser, GroundAtAGrazingAngleDoesNotOccludeItself) {
  Colouriser colouriser(
      {viewFrom(0.0, 0)}, [](std::size_t) { return uniform(10, 20, 200); }, 0.05, ColourMemory{1});
  std::vector<MapPoint> ground = groundFrom(3.0F, 16.0F);
  colouriser.addSurface(ground);
  colouriser.equalise();
  EXPECT_EQ(colouriser.colour(ground), ground.size());
}

TEST(Colouriser, ObjectsOccludeTheGround) {
  Colouriser colouriser(
      {viewFrom(0.0, 0)}, [](std::size_t) { return uniform(10, 20, 200); }, 0.05, ColourMemory{1});
  std::vector<MapPoint> ground = groundFrom(3.0F, 16.0F), box;
  for (float y = 0.5F; y < 1.5F; y += 0.05F)  // 1 m high, at z = 8
    for (float x = -2.0F; x < 2.0F; x += 0.05F) {
      MapPoint point;
      point.p = {x, y, 8.0F};
      point.normal = -Eigen::Vector3f::UnitZ();
      box.push_back(point);
    }
  colouriser.addSurface(ground);
  colouriser.addSurface(box);
  colouriser.equalise();
  colouriser.colour(ground);
  for (const MapPoint& point : ground) {
    if (point.p.z() < 7.5F) {
      EXPECT_EQ(point.red, 200) << point.p.transpose();
    }
    if (point.p.z() > 9.0F && std::abs(point.p.x()) < 1.8F) {
      EXPECT_EQ(point.red, 0) << point.p.transpose();
    }
  }
}

TEST(Colouriser, ImagesThatCannotBeReadAreLeftOut) {
  const auto load = [](std::size_t image) {
    return image == 0 ? Picture() : image == 1 ? Picture{3, 1, std::vector<std::uint8_t>(9, 0)} : uniform(1, 200, 3);
  };
  Colouriser colouriser({viewFrom(0.0, 0), viewFrom(0.1, 1), viewFrom(0.2, 2)}, load, 0.05, ColourMemory{4});
  std::vector<MapPoint> wall = wallAt(3.0F, -0.5F, 0.5F);
  colouriser.addSurface(wall);
  colouriser.equalise();
  EXPECT_EQ(colouriser.colour(wall), wall.size());
  EXPECT_EQ(wall.front().green, 200);
}

TEST(Colouriser, DoesNotDependOnTheNumberOfThreadsNorOnTheMemoryForImages) {
  std::vector<std::vector<MapPoint>> results;
  for (const auto& [threads, cached_images] : {std::pair(1, 2), std::pair(2, 2), std::pair(2, 1), std::pair(1, 100)}) {
    const urban_nav_core::ThreadLimit limit(threads);
    std::vector<ColourView> views;
    for (std::size_t i = 0; i < 4; ++i) views.push_back(viewFrom(0.3 * static_cast<double>(i), i));
    Colouriser colouriser(
        views,
        [](std::size_t image) {
          Picture picture = uniform(0, 0, 0);
          for (std::size_t i = 0; i < picture.bgr.size(); ++i)
            picture.bgr[i] = static_cast<std::uint8_t>(30 + (i / 7 + 13 * image) % 180);
          return picture;
        },
        0.05, ColourMemory{static_cast<std::size_t>(cached_images)});
    std::vector<MapPoint> wall = wallAt(3.0F, -1.0F, 1.5F);
    colouriser.addSurface(wall);
    colouriser.equalise();
    colouriser.colour(wall);
    results.push_back(wall);
  }
  for (const std::vector<MapPoint>& result : results)
    for (std::size_t i = 0; i < result.size(); ++i) {
      EXPECT_EQ(results[0][i].red, result[i].red);
      EXPECT_EQ(results[0][i].blue, result[i].blue);
    }
}

TEST(Colouriser, TheResultDoesNotDependOnTheMemoryForDepthMaps) {
  std::vector<ColourView> views;
  for (std::size_t i = 0; i < 40; ++i) views.push_back(viewFrom(0.7 * static_cast<double>(i), i));
  const auto load = [](std::size_t image) {
    return uniform(static_cast<std::uint8_t>(30 + image), 90, static_cast<std::uint8_t>(200 - 2 * image));
  };
  const auto colour = [&](std::size_t depth_bytes) {
    Colouriser colouriser(views, load, 0.05, {4, depth_bytes, {}});
    std::vector<std::vector<MapPoint>> tiles;
    for (float x = -2.0F; x < 30.0F; x += 4.0F) {
      tiles.push_back(wallAt(6.0F, x, x + 4.0F));
      tiles.push_back(wallAt(3.0F, x, x + 0.5F));  // occludes a part of it
    }
    for (const std::vector<MapPoint>& tile : tiles) colouriser.addSurface(tile);
    colouriser.equalise();
    std::vector<int> colours;
    for (std::vector<MapPoint>& tile : tiles) {
      colouriser.colour(tile);
      for (const MapPoint& point : tile) colours.insert(colours.end(), {point.red, point.green, point.blue});
    }
    return colours;
  };
  const std::vector<int> all_in_memory = colour(256U << 20U);
  EXPECT_TRUE(colour(0) == all_in_memory);
  EXPECT_GT(std::count(all_in_memory.begin(), all_in_memory.end(), 90), 1000);
}

TEST(DepthMapPool, HoldsWhatIsAskedForAndKeepsTheOthersInAFile) {
  const urban_nav_core::Pinhole camera{200.0, 200.0, 160.0, 120.0, kTestWidth, kTestHeight};
  const std::size_t bytes = sizeof(float) * kTestWidth * kTestHeight / 16;
  DepthMapPool pool(2 * bytes, "/no/such/folder");
  for (int i = 0; i < 6; ++i) pool.add(camera);
  for (std::size_t i = 0; i < 6; ++i) {
    pool.hold({i}, DepthMapPool::Access::Write);
    pool.at(i).add({100.0, 100.0, 1.0 + static_cast<double>(i)}, 0.05);
    EXPECT_LE(pool.bytesInMemory(), 2 * bytes);
  }
  for (const std::size_t i : {0U, 3U, 5U, 1U}) {
    pool.hold({i}, DepthMapPool::Access::Read);
    const double depth = 1.0 + static_cast<double>(i);
    EXPECT_TRUE(pool.at(i).isVisible({100.0, 100.0, depth}, {{0.0, 0.0, depth}, {0.0, 0.0, 0.0}}));
    EXPECT_FALSE(pool.at(i).isVisible({100.0, 100.0, depth + 1.0}, {{0.0, 0.0, depth + 1.0}, {0.0, 0.0, 0.0}}));
    EXPECT_TRUE(pool.at(i).isVisible({20.0, 20.0, 50.0}, {{0.0, 0.0, 50.0}, {0.0, 0.0, 0.0}})) << "nothing is there";
  }
  pool.hold({0, 1, 2, 3, 4, 5}, DepthMapPool::Access::Read);
  EXPECT_EQ(pool.bytesInMemory(), 6 * bytes) << "more than the budget, if asked for at once";
  pool.hold({2}, DepthMapPool::Access::Read);
  EXPECT_LE(pool.bytesInMemory(), 2 * bytes);
}

}  // namespace
}  // namespace laser_mapper
