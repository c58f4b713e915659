// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/pictures/match_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>

#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_registration/testing/photographer.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::testing::lookingAlong;
using urban_nav_core::testing::texturedRoom;
using urban_nav_registration::testing::Photographer;

struct ViewColour {
  int blue = 0, green = 0, red = 0;
  bool isGrey() const { return blue == green && green == red; }
};

ViewColour colourAt(const Picture& picture, int u, int v) {
  const std::uint8_t* p = &picture.bgr[3 * static_cast<std::size_t>(v * picture.width + u)];
  return {p[0], p[1], p[2]};
}

int coloured(const Picture& picture, int from_row, int to_row) {
  int count = 0;
  for (int v = from_row; v < to_row; ++v)
    for (int u = 0; u < picture.width; ++u)
      if (!colourAt(picture, u, v).isGrey()) ++count;
  return count;
}

Keyframe someView(double heading) {
  Photographer photographer(texturedRoom());
  return photographer.keyframe(lookingAlong({0.0, 0.0, 1.0}, heading), 1.0, 50);
}

/// A keyframe with a size but without an image.
Keyframe emptyView(int width, int height) {
  Keyframe keyframe;
  keyframe.width = width;
  keyframe.height = height;
  return keyframe;
}

TEST(MatchPicture, ShowsTheViewsSideBySideOrAboveEachOther) {
  const Keyframe a = someView(0.1), b = someView(0.4);
  const Picture beside = drawMatches(a, b, {});
  EXPECT_EQ(beside.width, 2 * 512 + 4);
  EXPECT_GT(beside.height, 384);
  ASSERT_EQ(beside.bgr.size(), static_cast<std::size_t>(3 * beside.width * beside.height));
  EXPECT_EQ(coloured(beside, 0, 384), 0);
  const cv::Mat keyframe_a = cv::imdecode(a.image, cv::IMREAD_GRAYSCALE),
                keyframe_b = cv::imdecode(b.image, cv::IMREAD_GRAYSCALE);
  MatchPictureOptions options;
  options.stacked = true;
  const Picture above = drawMatches(a, b, {}, options);
  EXPECT_EQ(above.width, 512);
  for (const cv::Point& p : {cv::Point(0, 0), cv::Point(100, 50), cv::Point(511, 383)}) {
    EXPECT_EQ(colourAt(beside, p.x, p.y).green, keyframe_a.at<std::uint8_t>(p));
    EXPECT_EQ(colourAt(beside, 516 + p.x, p.y).green, keyframe_b.at<std::uint8_t>(p));
    EXPECT_EQ(colourAt(above, p.x, p.y).green, keyframe_a.at<std::uint8_t>(p));
    EXPECT_EQ(colourAt(above, p.x, 388 + p.y).green, keyframe_b.at<std::uint8_t>(p));
  }
}

TEST(MatchPicture, MatchesAreLinesWhoseColourIsTheResidual) {
  const Keyframe a = emptyView(200, 100), b = emptyView(200, 100);
  const auto toMiddle = [&](double residual, bool inlier) {
    const Picture picture = drawMatches(a, b, {{{20.0, 30.0}, {160.0, 30.0}, residual, inlier}});
    return colourAt(picture, 190, 30);
  };
  const ViewColour good = toMiddle(0.0, true), bad = toMiddle(0.5, true), worse = toMiddle(50.0, true),
                   other = toMiddle(0.0, false);
  EXPECT_GT(good.green, good.red + 50);
  EXPECT_GT(bad.red, bad.green + 50);
  EXPECT_EQ(worse.red, bad.red);
  EXPECT_TRUE(other.isGrey());
  EXPECT_NE(other.green, colourAt(drawMatches(a, b, {}), 190, 30).green) << "the line is there";
}

TEST(MatchPicture, LargeViewsAreReducedWithTheirMatches) {
  const Keyframe a = emptyView(1280, 960), b = emptyView(1280, 960);
  MatchPictureOptions options;
  options.widest = 320;
  const Picture picture = drawMatches(a, b, {{{400.0, 400.0}, {400.0, 400.0}, 0.0, true}}, options);
  EXPECT_EQ(picture.width, 2 * 320 + 4);
  EXPECT_FALSE(colourAt(picture, 100, 100).isGrey());
  EXPECT_FALSE(colourAt(picture, 424, 100).isGrey());
  EXPECT_TRUE(colourAt(picture, 200, 120).isGrey());
}

TEST(MatchPicture, AMissingOrDamagedViewIsReportedInItsPanel) {
  const Keyframe good = someView(0.1);
  Keyframe cut = good, noise = good, lying = good;
  cut.image.resize(30);
  noise.image.assign(5000, 0x5A);
  lying.width = 300;
  const std::vector<MatchedPixels> pixels = {{{10.0, 10.0}, {20.0, 20.0}, 0.1, true}};
  for (const Keyframe& bad : {Keyframe(), cut, noise, lying, emptyView(-5, 7), emptyView(1 << 29, 1 << 29)}) {
    for (const bool first : {true, false}) {
      const Picture picture = drawMatches(first ? bad : good, first ? good : bad, pixels);
      ASSERT_LE(picture.width, 2000);
      ASSERT_EQ(picture.bgr.size(), static_cast<std::size_t>(3 * picture.width * picture.height));
      EXPECT_EQ(colourAt(picture, first ? 2 : picture.width - 3, 2).blue, 110);
      EXPECT_FALSE(encodeJpeg(picture).empty());
    }
  }
  EXPECT_GT(drawMatches({}, {}, pixels).width, 0);
}

TEST(MatchPicture, PlacesThatAreNoneAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Keyframe a = emptyView(200, 100), b = emptyView(200, 100);
  const Picture picture = drawMatches(a, b,
                                      {{{nan, 3.0}, {4.0, 4.0}, 0.1, true},
                                       {{3.0, 3.0}, {4.0, inf}, 0.1, true},
                                       {{3.0, 3.0}, {1e300, 4.0}, 0.1, true},
                                       {{-3.0, 3.0}, {4.0, 4.0}, 0.1, true}});
  EXPECT_EQ(coloured(picture, 0, 100), 0);
  const Picture doubtful = drawMatches(a, b, {{{3.0, 60.0}, {4.0, 60.0}, nan, true}});
  EXPECT_GT(coloured(doubtful, 0, 100), 0);
}

TEST(MatchPicture, ComesAsJpegToo) {
  const Picture picture = drawMatches(someView(0.1), someView(0.4), {});
  const cv::Mat back = cv::imdecode(encodeJpeg(picture), cv::IMREAD_COLOR);
  EXPECT_EQ(back.cols, picture.width);
  EXPECT_EQ(back.rows, picture.height);
  EXPECT_NEAR(back.at<cv::Vec3b>(100, 100)[1], colourAt(picture, 100, 100).green, 25);
  EXPECT_TRUE(encodeJpeg({}).empty());
  EXPECT_TRUE(encodeJpeg({4, 4, {1, 2, 3}}).empty());
}

}  // namespace
}  // namespace urban_nav_registration
