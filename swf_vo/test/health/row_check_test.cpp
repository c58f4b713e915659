// SPDX-License-Identifier: BSD-3-Clause
#include "health/row_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "recordings.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::testing::GreyImage;
using urban_nav_core::testing::StereoFrame;

StereoFrame roomPair() { return inTheRoom("loop", 1.0, 2).frames.front(); }

// The image of a camera rotated about its axis and shifted down, to whole pixels.
GreyImage displaced(const GreyImage& image, double roll_rad, double lower_px) {
  GreyImage result = image;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      const double x = u - 0.5 * image.width, y = v - lower_px - 0.5 * image.height;
      const int from_u =
                    static_cast<int>(std::lround(std::cos(roll_rad) * x + std::sin(roll_rad) * y + 0.5 * image.width)),
                from_v = static_cast<int>(
                    std::lround(-std::sin(roll_rad) * x + std::cos(roll_rad) * y + 0.5 * image.height));
      const int cu = std::clamp(from_u, 0, image.width - 1), cv = std::clamp(from_v, 0, image.height - 1);
      result.pixels[static_cast<std::size_t>(v * image.width + u)] =
          image.pixels[static_cast<std::size_t>(cv * image.width + cu)];
    }
  return result;
}

TEST(RowCheck, RectifiedRowsAgree) {
  const StereoFrame frame = roomPair();
  const auto disagree = RowCheck().measure(frame.pair());
  ASSERT_TRUE(disagree.has_value());
  EXPECT_LE(*disagree, 1.0);
}

TEST(RowCheck, ReportsTheShiftOfAnImage) {
  for (const double lower : {-17.0, -6.0, 3.0, 12.0}) {
    StereoFrame frame = roomPair();
    frame.right = displaced(frame.right, 0.0, lower);
    const auto disagree = RowCheck().measure(frame.pair());
    ASSERT_TRUE(disagree.has_value()) << lower;
    EXPECT_NEAR(*disagree, std::abs(lower), 1.0) << lower;
    EXPECT_LE(RowCheck().measure(frame.pair(), lower).value_or(9.0), 1.0) << lower;
  }
}

// A quarter of the width is the median distance of an image's pixels from the axis.
TEST(RowCheck, DetectsARoll) {
  constexpr double kRoll = 0.05;
  StereoFrame frame = roomPair();
  frame.right = displaced(frame.right, kRoll, 0.0);
  const auto disagree = RowCheck().measure(frame.pair());
  ASSERT_TRUE(disagree.has_value());
  EXPECT_NEAR(*disagree, kRoll * 0.25 * frame.left.width, 0.5 * kRoll * 0.25 * frame.left.width);
}

TEST(RowCheck, ReportsNothingForUnrelatedImages) {
  StereoFrame frame = roomPair();
  std::fill(frame.right.pixels.begin(), frame.right.pixels.end(), std::uint8_t{100});
  EXPECT_FALSE(RowCheck().measure(frame.pair()).has_value());
}

TEST(RowCheck, MeasuresAPairInTwenty) {
  const StereoFrame straight = roomPair();
  StereoFrame lower = straight;
  lower.right = displaced(lower.right, 0.0, 12.0);
  RowCheck rows;
  EXPECT_LE(rows.measureSometimes(straight.pair()).value_or(9.0), 1.0);
  int answers = 1;
  while (answers < 100 && rows.measureSometimes(lower.pair()).value_or(9.0) <= 1.0) ++answers;
  EXPECT_EQ(answers, 20);
  EXPECT_NEAR(rows.measureSometimes(straight.pair()).value_or(0.0), 12.0, 1.0);
}

TEST(SwfVo, NamesImagesThatAreNotRectified) {
  const Recording& room = inTheRoom("loop", 1.0, 10);
  SwfVo filter(Parameters(), stereoCamera(), urban_nav_core::Pose());
  for (std::size_t i = 0; i < 5; ++i) {
    StereoFrame frame = room.frames[i];
    frame.right = displaced(frame.right, 0.0, 12.0);
    const Frame& now = filter.process(frame.pair());
    expectProper(now);
    EXPECT_NE(now.status.health, urban_nav_core::Health::Ok) << i;
    EXPECT_EQ(static_cast<Reason>(now.status.reason), Reason::NotRectified) << i << ": " << now.status.sentence;
  }
}

}  // namespace
}  // namespace swf_vo
