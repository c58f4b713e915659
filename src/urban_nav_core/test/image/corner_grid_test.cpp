// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/corner_grid.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>

#include "urban_nav_core/image/fast.hpp"
#include "urban_nav_core/image/pyramid.hpp"
#include "urban_nav_core/testing/allocations.hpp"

namespace urban_nav_core {
namespace {

std::vector<Corner> randomCorners(int n, int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Corner> corners;
  for (int i = 0; i < n; ++i) {
    corners.push_back({static_cast<std::int16_t>(random() % static_cast<unsigned>(width)),
                       static_cast<std::int16_t>(random() % static_cast<unsigned>(height)),
                       static_cast<std::uint8_t>(5 + random() % 60)});
  }
  return corners;
}

using CornerSet = std::multiset<std::tuple<int, int, int>>;

void insertInto(CornerSet& set, const Corner& corner) { set.emplace(corner.u, corner.v, corner.fast); }

TEST(CornerGrid, FindsWhatASearchThroughAllFinds) {
  const std::vector<Corner> corners = randomCorners(700, 333, 201, 1);
  CornerGrid grid(16);
  grid.assign(corners, 333, 201);
  ASSERT_EQ(grid.size(), corners.size());
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-40.0, 380.0), v(-40.0, 240.0), r(0.0, 60.0);
  std::size_t found_in_all = 0;
  for (int i = 0; i < 500; ++i) {
    const double u0 = u(random), v0 = v(random), radius = r(random);
    CornerSet expected, found;
    for (const Corner& c : corners) {
      if ((c.u - u0) * (c.u - u0) + (c.v - v0) * (c.v - v0) <= radius * radius) insertInto(expected, c);
    }
    grid.forEachWithin(u0, v0, radius, [&](const Corner& c, std::size_t index) {
      EXPECT_EQ(grid.corners()[index], c);
      insertInto(found, c);
    });
    ASSERT_EQ(found, expected) << "about " << u0 << ", " << v0 << " within " << radius;
    found_in_all += found.size();
  }
  EXPECT_GT(found_in_all, 5000U);
}

TEST(CornerGrid, FindsTheBandOfAStereoSearch) {
  const std::vector<Corner> corners = randomCorners(500, 200, 100, 3);
  CornerGrid grid(16);
  grid.assign(corners, 200, 100);
  CornerSet expected, found;
  for (const Corner& c : corners) {
    if (c.u >= 20 && c.u <= 90.5 && c.v >= 49 && c.v <= 51) insertInto(expected, c);
  }
  grid.forEachInside(20, 49, 90.5, 51, [&](const Corner& c, std::size_t) { insertInto(found, c); });
  EXPECT_FALSE(found.empty());
  EXPECT_EQ(found, expected);
}

TEST(CornerGrid, EmptyAndRefilled) {
  CornerGrid grid;
  int visits = 0;
  const auto count = [&](const Corner&, std::size_t) { ++visits; };
  grid.forEachWithin(5, 5, 100, count);
  grid.assign({}, 100, 100);
  grid.forEachWithin(5, 5, 100, count);
  EXPECT_EQ(visits, 0);
  grid.assign({{99, 99, 1}}, 100, 100);
  grid.forEachWithin(99, 99, 0, count);
  EXPECT_EQ(visits, 1);
}

TEST(CornerCap, KeepsTheBestOfEachCell) {
  const CornerQuota quota{32, 30, 3, 8};
  // The left half is busy, the right half has few and weak corners.
  std::vector<Corner> corners = randomCorners(600, 96, 96, 4);
  for (const Corner& weak : randomCorners(40, 96, 96, 5)) {
    corners.push_back({static_cast<std::int16_t>(weak.u + 96), weak.v, static_cast<std::uint8_t>(5 + weak.fast / 4)});
  }
  std::vector<Corner> kept = corners;
  CornerCap(quota).apply(kept, 192, 96);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 6; ++column) {
      const auto inside = [&](const Corner& c) { return c.v / 32 == row && c.u / 32 == column; };
      std::vector<int> all, stayed;
      for (const Corner& c : corners) {
        if (inside(c)) all.push_back(c.fast);
      }
      for (const Corner& c : kept) {
        if (inside(c)) stayed.push_back(c.fast);
      }
      std::sort(all.rbegin(), all.rend());
      std::sort(stayed.rbegin(), stayed.rend());
      const auto strong = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](int s) { return s > 30; }));
      const std::size_t expected = std::min(all.size(), std::clamp<std::size_t>(strong, 3, 8));
      ASSERT_EQ(stayed.size(), expected) << row << ", " << column;
      all.resize(expected);
      EXPECT_EQ(stayed, all);
    }
  }
}

TEST(CornerCap, OfEqualsTheFirstStayAndOrderIsKept) {
  std::vector<Corner> corners;
  for (int i = 0; i < 10; ++i) corners.push_back({static_cast<std::int16_t>(i), 0, 50});
  corners.push_back({11, 0, 60});
  CornerCap({32, 20, 1, 4}).apply(corners, 32, 32);
  ASSERT_EQ(corners.size(), 4U);
  EXPECT_EQ(corners[0].u, 0);
  EXPECT_EQ(corners[1].u, 1);
  EXPECT_EQ(corners[2].u, 2);
  EXPECT_EQ(corners[3].u, 11);
}

TEST(CornerGrid, FromPixelsToTheGridNothingIsAllocatedOnceBuffersHaveGrown) {
  if (!testing::countsAllocations()) GTEST_SKIP() << "allocations are not counted under a sanitizer";
  std::mt19937 random(8);
  std::vector<std::uint8_t> pixels(320 * 240);
  for (std::uint8_t& pixel : pixels) pixel = static_cast<std::uint8_t>(random() & 255U);
  Pyramid pyramid(3);
  Fast fast;
  CornerCap cap(CornerQuota{});
  CornerGrid grid;
  std::vector<Corner> corners;
  std::int64_t before = 0;
  for (int i = 0; i < 4; ++i) {
    if (i == 1) before = testing::allocations();
    pyramid.build({pixels.data(), 320, 240, 320});
    for (int l = 0; l < pyramid.levels(); ++l) {
      corners = fast.detect(pyramid.level(l), 10, Fast::Suppression::LocalMaximum);
      cap.apply(corners, pyramid.level(l).width, pyramid.level(l).height);
      grid.assign(corners, pyramid.level(l).width, pyramid.level(l).height);
    }
  }
  EXPECT_EQ(testing::allocations(), before);
}

}  // namespace
}  // namespace urban_nav_core
