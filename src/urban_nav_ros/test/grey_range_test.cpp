// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/grey_range.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "urban_nav_ros/image.hpp"

namespace urban_nav_ros {
namespace {

/// A ramp of the values from `low` to `high`.
cv::Mat ramp(int low, int high) {
  cv::Mat image(120, 160, CV_16UC1);
  for (int i = 0; i < image.rows * image.cols; ++i)
    image.at<std::uint16_t>(i / image.cols, i % image.cols) =
        static_cast<std::uint16_t>(low + (high - low) * (i % 1000) / 999);
  return image;
}

GreyScale computeScale(const cv::Mat& image) {
  GreyRange range;
  range.add(image);
  return range.scale();
}

TEST(GreyRange, BitsInUseGiveWhatAnEightBitCameraShows) {
  for (const int bits : {8, 10, 12, 14, 16}) {
    const int factor = 1 << (bits - 8);
    const cv::Mat eight = toEightBits(ramp(0, 255), kPixelsAsStored), deep = ramp(0, 255) * factor;
    const GreyScale scale = computeScale(deep);
    EXPECT_EQ(cv::norm(toEightBits(deep, scale), eight, cv::NORM_INF), 0.0) << bits;
  }
}

TEST(GreyRange, OneHotPixelDoesNotCount) {
  cv::Mat image = ramp(0, 4000);
  const GreyScale before = computeScale(image);
  image.at<std::uint16_t>(7, 9) = 65535;
  EXPECT_EQ(computeScale(image).step, before.step);
  EXPECT_EQ(computeScale(image).step, 16.0);
  EXPECT_EQ(toEightBits(image, before).at<std::uint8_t>(7, 9), 255);
}

TEST(GreyRange, NarrowRangesAreStretched) {
  const cv::Mat image = ramp(7000, 7500);
  const cv::Mat grey = toEightBits(image, computeScale(image));
  double low = 0.0, high = 0.0;
  cv::minMaxLoc(grey, &low, &high);
  EXPECT_LE(low, 1.0);
  EXPECT_GE(high, 254.0);
  EXPECT_NEAR(cv::mean(grey)[0], 127.0, 3.0);
}

TEST(GreyRange, BothCamerasHaveOneScaleThatSettles) {
  GreyRange range;
  range.add(ramp(0, 900));
  range.add(ramp(0, 3000));
  EXPECT_EQ(range.scale().step, 16.0);
  for (int i = 0; i < 40; ++i) range.add(ramp(0, 3000));
  ASSERT_TRUE(range.isSettled());
  range.add(ramp(0, 7000));
  EXPECT_EQ(range.scale().step, 16.0) << "saturated";
  range.add(ramp(0, 60000));
  EXPECT_EQ(range.scale().step, 256.0) << "after a dark start";
}

TEST(GreyRange, EightBitsAndDamageHaveNoInfluence) {
  GreyRange range;
  const GreyScale before = range.scale();
  sensor_msgs::Image image;
  image.encoding = "mono16";
  image.width = image.height = image.step = 4;
  range.add(image);  // too short a step
  sensor_msgs::CompressedImage compressed;
  range.add(compressed);
  cv::imencode(".png", ramp(0, 255), compressed.data);
  compressed.data.resize(60);
  range.add(compressed);
  range.add(cv::Mat(4, 4, CV_8UC1, cv::Scalar(9)));
  EXPECT_EQ(range.scale().step, before.step);
  EXPECT_EQ(computeScale(cv::Mat(4, 4, CV_16UC1, cv::Scalar(300))).offset, 0.0) << "one value: no range to stretch";
}

TEST(GreyRange, DeepPngCountsLikeRawPixels) {
  GreyRange range;
  sensor_msgs::CompressedImage compressed;
  cv::imencode(".png", ramp(7000, 7500), compressed.data);
  range.add(compressed);
  EXPECT_EQ(range.scale().offset, computeScale(ramp(7000, 7500)).offset);
}

}  // namespace
}  // namespace urban_nav_ros
