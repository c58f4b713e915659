// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/stereo_assembler.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "support/time.hpp"

namespace urban_nav_core {
namespace {

OwnedImage image(StampNs stamp, std::uint8_t value) {
  auto pixels = std::make_shared<std::vector<std::uint8_t>>(16, value);
  return {stamp, ImageView{pixels->data(), 4, 4, 4}, pixels};
}

MotionInput motion(StampNs from, StampNs to) {
  MotionInput input;
  input.from = from;
  input.to = to;
  return input;
}

TEST(StereoAssembler, PartnersLeaveTogetherWhicheverComesFirst) {
  StereoAssembler assembler;
  assembler.addLeft(image(100 * kMillisecond, 1));
  EXPECT_FALSE(assembler.take());
  assembler.addRight(image(101 * kMillisecond, 2));
  assembler.addRight(image(149 * kMillisecond, 4));
  assembler.addLeft(image(150 * kMillisecond, 3));
  const auto first = assembler.take(), second = assembler.take();
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(assembler.take());
  EXPECT_EQ(first->pair.stamp, 100 * kMillisecond);
  EXPECT_EQ(first->pair.left.at(0, 0), 1);
  EXPECT_EQ(first->pair.right.at(0, 0), 2);
  EXPECT_EQ(second->pair.stamp, 150 * kMillisecond);
  EXPECT_EQ(second->pair.left.at(3, 3), 3);
  EXPECT_EQ(second->pair.right.at(3, 3), 4);
  EXPECT_EQ(assembler.leftsMissing() + assembler.rightsMissing(), 0);
}

TEST(StereoAssembler, AnImageWithoutPartnerLeavesAloneOnceALaterOneShowsIt) {
  StereoAssembler assembler;
  assembler.addLeft(image(100 * kMillisecond, 1));
  assembler.addLeft(image(150 * kMillisecond, 3));
  auto lone = assembler.take();
  ASSERT_TRUE(lone);
  EXPECT_EQ(lone->pair.stamp, 100 * kMillisecond);
  EXPECT_FALSE(lone->pair.left.empty());
  EXPECT_TRUE(lone->pair.right.empty());

  assembler.addRight(image(200 * kMillisecond, 6));
  lone = assembler.take();
  ASSERT_TRUE(lone);
  EXPECT_EQ(lone->pair.stamp, 150 * kMillisecond);
  EXPECT_FALSE(assembler.take());

  assembler.finish();
  lone = assembler.take();
  ASSERT_TRUE(lone);
  EXPECT_EQ(lone->pair.stamp, 200 * kMillisecond);
  EXPECT_TRUE(lone->pair.left.empty());
  EXPECT_EQ(assembler.rightsMissing(), 2);
  EXPECT_EQ(assembler.leftsMissing(), 1);
  assembler.finish();
  EXPECT_FALSE(assembler.take());
}

TEST(StereoAssembler, ToleranceIsTheLargestDifferenceThatPairs) {
  StereoAssembler assembler(10 * kMillisecond);
  assembler.addLeft(image(100 * kMillisecond, 1));
  assembler.addRight(image(110 * kMillisecond, 1));
  EXPECT_TRUE(assembler.take());
  assembler.addLeft(image(200 * kMillisecond, 1));
  assembler.addRight(image(210 * kMillisecond + 1, 1));
  const auto lone = assembler.take();
  ASSERT_TRUE(lone);
  EXPECT_TRUE(lone->pair.right.empty());
}

TEST(StereoAssembler, APairTakesTheMotionThatEndedBeforeIt) {
  StereoAssembler assembler;
  for (StampNs t = 0; t < 200; t += 20) assembler.addMotion(motion(t * kMillisecond, (t + 20) * kMillisecond));
  assembler.addLeft(image(100 * kMillisecond, 1));
  assembler.addRight(image(100 * kMillisecond, 1));
  assembler.addLeft(image(150 * kMillisecond, 1));
  assembler.addRight(image(150 * kMillisecond, 1));
  const auto first = assembler.take(), second = assembler.take();
  ASSERT_TRUE(first && second);
  ASSERT_EQ(first->inputs.size(), 5U);
  EXPECT_EQ(first->inputs.back().to, 100 * kMillisecond);
  ASSERT_EQ(second->inputs.size(), 2U);
  EXPECT_EQ(second->inputs.front().from, 100 * kMillisecond);
  EXPECT_EQ(second->inputs.back().to, 140 * kMillisecond);
}

TEST(StereoAssembler, PixelsLiveAsLongAsThePair) {
  StereoAssembler assembler;
  std::weak_ptr<const void> alive;
  {
    OwnedImage left = image(1, 42);
    alive = left.owner;
    assembler.addLeft(std::move(left));
  }
  assembler.addRight(image(1, 43));
  auto pair = assembler.take();
  ASSERT_TRUE(pair);
  EXPECT_FALSE(alive.expired());
  EXPECT_EQ(pair->pair.left.at(2, 2), 42);
  pair.reset();
  EXPECT_TRUE(alive.expired());
}

}  // namespace
}  // namespace urban_nav_core
