// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "filter/components.hpp"
#include "filter/depth_edges.hpp"
#include "filter/unsupported_regions.hpp"
#include "sgm/descriptors.hpp"

namespace dense_stereo {
namespace {

template <typename T = std::uint16_t>
Padded<T> constantMap(int width, int height, T value) {
  Padded<T> map;
  map.resize(width, height);
  map.fill(value);
  return map;
}

/// Size of the 8-connected component of a pixel, by flood fill.
int floodFill(const Padded<std::uint16_t>& d, int u, int v) {
  std::vector<char> seen(static_cast<std::size_t>(d.width() * d.height()), 0);
  std::vector<std::pair<int, int>> stack{{u, v}};
  seen[static_cast<std::size_t>(v * d.width() + u)] = 1;
  int size = 0;
  while (!stack.empty()) {
    const auto [x, y] = stack.back();
    stack.pop_back();
    ++size;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int a = x + dx, b = y + dy;
        if (a < 0 || b < 0 || a >= d.width() || b >= d.height()) continue;
        if (seen[static_cast<std::size_t>(b * d.width() + a)] != 0 || d.row(b)[a] == Winners::kInvalid) continue;
        if (std::abs(d.row(b)[a] - d.row(y)[x]) > 1) continue;
        seen[static_cast<std::size_t>(b * d.width() + a)] = 1;
        stack.emplace_back(a, b);
      }
  }
  return size;
}

TEST(SmallComponents, RemovesWhatAFloodFillFindsSmall) {
  std::mt19937 random(4);
  for (int round = 0; round < 4; ++round) {
    Padded<std::uint16_t> map = constantMap(60, 40, std::uint16_t{0});
    for (int v = 0; v < 40; ++v)
      for (int u = 0; u < 60; ++u)
        map.row(v)[u] = random() % 5 == 0 ? Winners::kInvalid : static_cast<std::uint16_t>(400 + random() % 4);
    const Padded<std::uint16_t> before = map;
    SmallComponents().remove(map, 6);
    for (int v = 0; v < 40; ++v)
      for (int u = 0; u < 60; ++u) {
        if (before.row(v)[u] == Winners::kInvalid) continue;
        ASSERT_EQ(map.row(v)[u] == Winners::kInvalid, floodFill(before, u, v) < 6) << u << " " << v;
      }
  }
}

TEST(DepthEdges, MarksAWindowAroundAStepAndNothingElse) {
  Padded<std::uint16_t> map = constantMap(64, 32, std::uint16_t{10});
  for (int v = 0; v < 32; ++v)
    for (int u = 30; u < 64; ++u) map.row(v)[u] = 14;
  Padded<std::uint8_t> edges;
  DepthEdges().mark(map, edges);
  for (int v = 0; v < 32; ++v)
    for (int u = 0; u < 64; ++u) ASSERT_EQ(edges.row(v)[u] != 0, u >= 29 - 4 && u <= 30 + 4) << u << " " << v;
}

TEST(DepthEdges, DetectsEdgesAcrossOccludedStripsAndIgnoresSlants) {
  Padded<std::uint16_t> map = constantMap(64, 32, std::uint16_t{10}), slanted = constantMap(64, 32, std::uint16_t{0});
  Padded<std::uint8_t> edges;
  for (int v = 0; v < 32; ++v)
    for (int u = 0; u < 64; ++u) {
      if (u >= 24) map.row(v)[u] = u < 30 ? Winners::kInvalid : 20;
      slanted.row(v)[u] = static_cast<std::uint16_t>(10 + u / 2 + v / 2);
    }
  DepthEdges().mark(map, edges);
  EXPECT_NE(edges.row(10)[23], 0);
  EXPECT_NE(edges.row(10)[30], 0);
  EXPECT_EQ(edges.row(10)[10], 0);
  DepthEdges().mark(slanted, edges);
  for (int v = 0; v < 32; ++v)
    for (int u = 0; u < 64; ++u) ASSERT_EQ(edges.row(v)[u], 0);
}

/// Textured lower half below a flat, saturated sky, all at one disparity, as filled by semi-global matching.
TEST(UnsupportedRegions, RemovesTheFlatSkyAndKeepsTexture) {
  std::mt19937 random(1);
  Padded<std::uint8_t> left = constantMap(96, 96, std::uint8_t{255});
  Winners winners;
  winners.disparity = constantMap(96, 96, std::uint16_t{12});
  winners.cost = constantMap(96, 96, std::uint8_t{20});
  winners.rival = constantMap(96, 96, std::uint8_t{30});
  DisparityField field;
  field.disparity.resize(96, 96, 12.0F);
  field.noise.resize(96, 96, 0.1F);
  field.information.resize(96, 96, 0.0F);
  for (int v = 48; v < 96; ++v)
    for (int u = 0; u < 96; ++u) {
      left.row(v)[u] = static_cast<std::uint8_t>(random() % 200);
      field.information.row(v)[u] = 500.0F;
      winners.rival.row(v)[u] = 120;
    }
  extendRows(left);
  UnsupportedRegions().remove(left, winners, field);
  for (int u = 0; u < 96; ++u) {
    for (int v = 0; v < 47; ++v) ASSERT_LT(field.disparity.row(v)[u], 0.0F) << u << " " << v;
    for (int v = 49; v < 96; ++v) ASSERT_EQ(field.disparity.row(v)[u], 12.0F) << u << " " << v;
  }
}

/// The windows of the seven lowest rows of a flat sky contain the texture below it.
TEST(UnsupportedRegions, RemovesTheSkyUpToTheOutlineAndKeepsAFlatPatchWithinTexture) {
  constexpr int kHorizon = 60, kReached = 53;
  std::mt19937 random(2);
  Padded<std::uint8_t> left = constantMap(96, 128, std::uint8_t{220});
  Winners winners;
  winners.disparity = constantMap(96, 128, std::uint16_t{12});
  winners.cost = constantMap(96, 128, std::uint8_t{20});
  winners.rival = constantMap(96, 128, std::uint8_t{30});
  DisparityField field;
  field.disparity.resize(96, 128, 12.0F);
  field.noise.resize(96, 128, 0.1F);
  field.information.resize(96, 128, 0.0F);
  const auto isPatch = [](int u, int v) { return u >= 40 && u < 48 && v >= 90 && v < 98; };
  for (int v = kReached; v < 128; ++v)
    for (int u = 0; u < 96; ++u) {
      field.information.row(v)[u] = 500.0F;
      winners.rival.row(v)[u] = 120;
      if (v >= kHorizon) left.row(v)[u] = isPatch(u, v) ? 220 : static_cast<std::uint8_t>(random() % 120);
    }
  extendRows(left);
  UnsupportedRegions().remove(left, winners, field);
  for (int u = 0; u < 96; ++u) {
    for (int v = 0; v < kHorizon; ++v) ASSERT_LT(field.disparity.row(v)[u], 0.0F) << u << " " << v;
    for (int v = kHorizon + 1; v < 128; ++v) ASSERT_EQ(field.disparity.row(v)[u], 12.0F) << u << " " << v;
  }
}

}  // namespace
}  // namespace dense_stereo
