// SPDX-License-Identifier: BSD-3-Clause
#include "materials/tile.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "noise/hash.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector2f;

Tile randomTile(int size, float period) {
  Draw draw(3);
  std::vector<float> mix, tone;
  for (int i = 0; i < size * size; ++i) {
    mix.push_back(static_cast<float>(draw.uniform()));
    tone.push_back(static_cast<float>(draw.uniform(-1, 1)));
  }
  return {size, period, mix, tone};
}

TEST(Footprint, HasTheAxesOfThePixelsEllipse) {
  const Footprint round = computeFootprint({0.01F, 0.0F}, {0.0F, 0.01F}, 8);
  EXPECT_EQ(round.taps, 1);
  EXPECT_NEAR(round.width, 0.01F, 1e-6F);
  for (const float angle : {0.0F, 0.4F, 1.2F, 1.5708F, 2.5F}) {
    const Vector2f along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
    const Footprint flat = computeFootprint(0.01F * across, 0.05F * along, 8);
    EXPECT_NEAR(flat.width, 0.01F, 1e-4F);
    EXPECT_NEAR(std::abs(flat.length.dot(along)), 0.05F, 1e-4F);
    EXPECT_NEAR(flat.length.dot(across), 0.0F, 1e-4F);
    EXPECT_EQ(flat.taps, 5);
  }
  const Footprint flattest = computeFootprint({0.001F, 0.0F}, {0.0F, 1.0F}, 6);
  EXPECT_EQ(flattest.taps, 6);
  EXPECT_NEAR(flattest.width, 1.0F / 6.0F, 1e-5F);
  EXPECT_EQ(computeFootprint({0, 0}, {0, 0}, 6).taps, 1);
}

TEST(Tile, GivesATexelAtItsMiddleAndGoesOnAtItsOtherSide) {
  std::vector<float> mix(64, 0.0F), tone(64, 0.0F);
  mix[8 * 2 + 7] = 1.0F, tone[8 * 2 + 7] = -0.5F;  // row 2, column 7
  const Tile tile(8, 2.0F, mix, tone);
  for (const float round : {-2.0F, 0.0F, 2.0F, 20.0F}) {
    const Tile::Value v = tile.read(Vector2f(7.5F * 0.25F + round, 2.5F * 0.25F - round), 0.0F);
    EXPECT_NEAR(v.mix, 1.0F, 1e-4F);
    EXPECT_NEAR(v.tone, -0.5F, 1e-4F);
    EXPECT_NEAR(tile.read(Vector2f(2.0F + round, 2.5F * 0.25F), 0.0F).mix, 0.5F, 1e-4F);  // half way to column 0
  }
}

TEST(Tile, EveryLevelHasTheSameMean) {
  const Tile tile = randomTile(64, 1.0F);
  for (const float width : {0.0F, 0.03F, 0.05F, 0.1F, 0.2F, 0.5F, 2.0F}) {
    double mix = 0.0, tone = 0.0;
    const int n = 128;
    for (int i = 0; i < n * n; ++i) {
      const Vector2f at((static_cast<float>(i % n) + 0.5F) / static_cast<float>(n),
                        (static_cast<float>(i / n) + 0.5F) / static_cast<float>(n));
      const Tile::Value v = tile.read(at, width);
      mix += static_cast<double>(v.mix) / (n * n), tone += static_cast<double>(v.tone) / (n * n);
    }
    EXPECT_NEAR(mix, static_cast<double>(tile.mean().mix), 1e-4) << width;
    EXPECT_NEAR(tone, static_cast<double>(tile.mean().tone), 2e-4) << width;
  }
}

TEST(Tile, AStripIsTheMeanOfItsTaps) {
  const Tile tile = randomTile(64, 1.0F);
  Footprint strip;
  strip.width = 0.02F, strip.length = Vector2f(0.06F, 0.03F), strip.taps = 3;
  const Vector2f at(0.3F, 0.7F), third = strip.length / 3.0F;
  const float mean =
      (tile.read(at - third, 0.02F).mix + tile.read(at, 0.02F).mix + tile.read(at + third, 0.02F).mix) / 3.0F;
  EXPECT_NEAR(tile.read(at, strip).mix, mean, 1e-5F);
}

TEST(Tile, ShufflesCopiesByWholeSteps) {
  std::vector<float> mix, tone(64 * 64, 0.0F);
  Draw draw(1);
  for (int i = 0; i < 64 * 64; ++i) mix.push_back(static_cast<float>(draw.uniform()));
  Tile tile(64, 1.0F, mix, tone);
  const Tile plain = tile;
  tile.shuffle({0.125F, 0.25F});
  int moved = 0;
  for (int k = 0; k < 20; ++k) {
    const Vector2f at(0.4F + static_cast<float>(k), 0.3F);
    bool found = false;
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 4; ++j) {
        found |=
            std::abs(
                tile.read(at, 0.0F).mix -
                plain.read(at + Vector2f(0.125F * static_cast<float>(i), 0.25F * static_cast<float>(j)), 0.0F).mix) <
            1e-4F;
      }
    }
    EXPECT_TRUE(found);
    moved += std::abs(tile.read(at, 0.0F).mix - plain.read(at, 0.0F).mix) > 0.01F;
  }
  EXPECT_GT(moved, 10);
}

}  // namespace
}  // namespace urban_nav_sim
