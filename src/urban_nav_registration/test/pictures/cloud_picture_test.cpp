// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/pictures/cloud_picture.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace urban_nav_registration {
namespace {

using urban_nav_core::PointCloud;
using urban_nav_core::Pose;

constexpr int kPanel = 200, kGap = 4;

struct CloudColour {
  int blue = 0, green = 0, red = 0;
  bool isRed() const { return red > blue + 60; }
  bool isBlue() const { return blue > red + 60; }
  bool isPurple() const { return !isRed() && !isBlue() && green < 200 && green + 20 < std::min(red, blue); }
};

struct Counts {
  int red = 0, blue = 0, purple = 0;
};

Counts computeCounts(const Picture& picture, int which) {
  Counts counts;
  for (int v = 20; v < kPanel - 30; ++v)  // without title and bar
    for (int u = which * (kPanel + kGap); u < which * (kPanel + kGap) + kPanel; ++u) {
      const std::uint8_t* p = &picture.bgr[3 * static_cast<std::size_t>(v * picture.width + u)];
      const CloudColour colour{p[0], p[1], p[2]};
      counts.red += colour.isRed() ? 1 : 0;
      counts.blue += colour.isBlue() ? 1 : 0;
      counts.purple += colour.isPurple() ? 1 : 0;
    }
  return counts;
}

/// A wall of 10 m by 3 m beside the origin.
PointCloud wall() {
  PointCloud cloud;
  for (int i = 0; i < 200; ++i)
    for (int j = 0; j < 60; ++j)
      cloud.points.emplace_back(0.05F * static_cast<float>(i) - 5.0F, 3.0F, 0.05F * static_cast<float>(j));
  return cloud;
}

PointCloud moved(const PointCloud& cloud, const Pose& T) {
  PointCloud result;
  for (const Eigen::Vector3f& point : cloud.points) result.points.push_back((T * point.cast<double>()).cast<float>());
  return result;
}

Picture drawn(const PointCloud& source, const PointCloud& target, const Pose& guess, const Pose& T,
              CloudPictureOptions options = {}) {
  options.panel = kPanel;
  return drawClouds(source, target, guess, T, options);
}

TEST(CloudPicture, PurpleWhereTheCloudsMeetAndTwoColoursWhereTheyDoNot) {
  const Pose T(urban_nav_core::Matrix3d::Identity(), {0.0, 1.5, 0.0});
  const Picture picture = drawn(moved(wall(), T.inverse()), wall(), Pose(), T);
  EXPECT_EQ(picture.width, 3 * kPanel + 2 * kGap);
  ASSERT_EQ(picture.bgr.size(), 3U * picture.width * picture.height);
  const Counts before = computeCounts(picture, 0), above = computeCounts(picture, 1), side = computeCounts(picture, 2);
  EXPECT_GT(before.red, 100);
  EXPECT_GT(before.blue, 100);
  EXPECT_GT(above.purple, 100);
  EXPECT_LT(above.red + above.blue, 200) << "the origins only";
  EXPECT_GT(side.purple, 3000) << "the wall's face";
}

TEST(CloudPicture, ShowsWhatSlides) {
  CloudPictureOptions options;
  const Picture plain = drawn(wall(), wall(), Pose(), Pose(), options);
  options.free_directions.push_back(urban_nav_core::Vector6d::Unit(0));
  const Picture with = drawn(wall(), wall(), Pose(), Pose(), options);
  ASSERT_EQ(plain.bgr.size(), with.bgr.size());
  EXPECT_NE(plain.bgr, with.bgr);
  options.free_directions = {urban_nav_core::Vector6d::Unit(5)};
  EXPECT_EQ(plain.bgr, drawn(wall(), wall(), Pose(), Pose(), options).bgr) << "a heading has no arrow";
}

TEST(CloudPicture, WhateverTheCloudsHold) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  PointCloud odd;
  odd.points = {{nan, 0.0F, 0.0F}, {inf, 1.0F, 0.0F}, {0.0F, -inf, nan}, {3e38F, 3e38F, -3e38F}};
  PointCloud one;
  one.points = {{1.0F, 2.0F, 3.0F}};
  const Pose far(urban_nav_core::Matrix3d::Identity(), {1e12, -1e12, 1e300});
  for (const PointCloud& source : {PointCloud(), odd, one, wall()})
    for (const PointCloud& target : {PointCloud(), odd, one, wall()})
      for (const Pose& T : {Pose(), far}) {
        const Picture picture = drawn(source, target, T, T);
        EXPECT_EQ(picture.bgr.size(), 3U * picture.width * picture.height);
        EXPECT_FALSE(encodeJpeg(picture).empty());
      }
}

}  // namespace
}  // namespace urban_nav_registration
