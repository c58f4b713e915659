// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/corners.hpp"

#include <gtest/gtest.h>

#include "rendered.hpp"

namespace swf_vo {
namespace {

using namespace urban_nav_core::testing;

TEST(Corners, AreFoundAtEachLevelOfBothImages) {
  RenderedSequence sequence(texturedRoom(), standing(lookingAlong({0.0, 0.0, 1.2}, 0.3)), smallCamera(1.0));
  Corners corners(3, 3, 12, 50);
  corners.extract(sequence.frame(0).pair());
  EXPECT_EQ(corners.levels(), 3);
  EXPECT_EQ(corners.top(), 3);
  EXPECT_EQ(corners.image(Side::Left, 2).width, 80);
  int sum = 0;
  for (int level = 0; level < 3; ++level) {
    EXPECT_GT(corners.at(Side::Left, level).size(), 5U);
    EXPECT_GT(corners.at(Side::Right, level).size(), 5U);
    sum += static_cast<int>(corners.at(Side::Left, level).size());
  }
  EXPECT_EQ(corners.count(Side::Left), sum);
}

TEST(Corners, TheThresholdFollowsTheScene) {
  SequenceOptions options = smallCamera(1.0);
  options.gain = [](double) { return 0.15; };
  RenderedSequence dim(texturedRoom(), standing(lookingAlong({0.0, 0.0, 1.2}, 0.3)), options);
  Corners corners(1, 2, 40, 50);
  corners.extract(dim.frame(0).pair());
  const int before = corners.count(Side::Left);
  for (int i = 1; i < 12; ++i) corners.extract(dim.frame(i).pair());
  EXPECT_GT(corners.count(Side::Left), before);
  EXPECT_GT(corners.count(Side::Left), 100);
}

TEST(Corners, SmallImagesHaveFewerLevels) {
  const std::vector<std::uint8_t> grey(64 * 64, 90);
  Corners corners(6, 6, 12, 50);
  corners.extract({0, {grey.data(), 64, 64, 64}, {grey.data(), 64, 64, 64}});
  EXPECT_EQ(corners.levels(), 3);
  EXPECT_EQ(corners.count(Side::Left), 0);
}

}  // namespace
}  // namespace swf_vo
