// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/depth_image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <vector>

namespace urban_nav_ros {
namespace {

template <typename Value>
sensor_msgs::Image depthMessage(const std::string& encoding, const std::vector<Value>& values, bool is_bigendian = false,
                                std::size_t padding = 0) {
  sensor_msgs::Image message;
  message.encoding = encoding;
  message.width = static_cast<std::uint32_t>(values.size());
  message.height = 1;
  message.step = static_cast<std::uint32_t>(values.size() * sizeof(Value) + padding);
  message.is_bigendian = is_bigendian ? 1 : 0;
  for (const Value& value : values) {
    std::uint8_t raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    for (std::size_t i = 0; i < sizeof value; ++i)
      message.data.push_back(raw[is_bigendian ? sizeof value - 1 - i : i]);
  }
  message.data.resize(message.step);
  return message;
}

std::vector<float> decoded(const DepthPixels& pixels) {
  EXPECT_EQ(pixels.fault, "");
  return {pixels.depth.begin<float>(), pixels.depth.end<float>()};
}

sensor_msgs::CompressedImage compressedDepth(const std::string& format, const cv::Mat& pixels, float a, float b) {
  sensor_msgs::CompressedImage message;
  message.format = format;
  message.data.resize(12);
  std::memcpy(message.data.data() + 4, &a, sizeof a);
  std::memcpy(message.data.data() + 8, &b, sizeof b);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", pixels, png);
  message.data.insert(message.data.end(), png.begin(), png.end());
  return message;
}

TEST(DepthImages, OfWholeNumbersAreInMillimetres) {
  const std::vector<std::uint16_t> stored = {0, 1, 1500, 65535};
  for (const bool is_bigendian : {false, true}) {
    const std::vector<float> depths = decoded(toDepth(depthMessage("16UC1", stored, is_bigendian, 6)));
    ASSERT_EQ(depths.size(), stored.size());
    for (std::size_t i = 0; i < stored.size(); ++i) EXPECT_FLOAT_EQ(depths[i], 0.001F * static_cast<float>(stored[i]));
  }
  EXPECT_FLOAT_EQ(decoded(toDepth(depthMessage("mono16", stored))).back(), 65.535F);
}

TEST(DepthImages, OfRealNumbersAreInMetresAndWithoutValueWhereTheyAreNotPositive) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(decoded(toDepth(depthMessage<float>("32FC1", {1.25F, nan, infinity, -infinity, -1.0F, 0.0F}))),
            (std::vector<float>{1.25F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F}));
}

TEST(DepthImages, OtherEncodingsAndTruncatedOnesAreFaults) {
  EXPECT_NE(toDepth(depthMessage<std::uint8_t>("rgb8", {1, 2, 3})).fault.find("rgb8"), std::string::npos);
  sensor_msgs::Image cut = depthMessage<float>("32FC1", {1.0F, 2.0F});
  cut.data.pop_back();
  EXPECT_NE(toDepth(cut).fault, "");
  cut.step = 0;
  EXPECT_NE(toDepth(cut).fault, "");
  cut.height = std::numeric_limits<std::uint32_t>::max();
  cut.step = 8;
  EXPECT_NE(toDepth(cut).fault, "");
}

TEST(DepthImages, OfTheTransportAreDecoded) {
  const cv::Mat millimetres = (cv::Mat_<std::uint16_t>(1, 3) << 0, 1000, 2500);
  EXPECT_EQ(decoded(toDepth(compressedDepth("16UC1; compressedDepth png", millimetres, 0.0F, 0.0F))),
            (std::vector<float>{0.0F, 1.0F, 2.5F}));
  // 100 / z - 5: 95 is at 1 m
  const cv::Mat inverse = (cv::Mat_<std::uint16_t>(1, 4) << 0, 95, 20, 3);
  const std::vector<float> depths = decoded(toDepth(compressedDepth("32FC1; compressedDepth", inverse, 100.0F, -5.0F)));
  EXPECT_EQ(depths[0], 0.0F);
  EXPECT_FLOAT_EQ(depths[1], 1.0F);
  EXPECT_FLOAT_EQ(depths[2], 4.0F);
  EXPECT_FLOAT_EQ(depths[3], 12.5F);
}

TEST(DepthImages, DamagedOnesOfTheTransportAreFaults) {
  const cv::Mat millimetres = (cv::Mat_<std::uint16_t>(1, 3) << 0, 1000, 2500);
  sensor_msgs::CompressedImage message = compressedDepth("16UC1; compressedDepth", millimetres, 0.0F, 0.0F);
  for (const std::size_t size : {std::size_t{0}, std::size_t{12}, std::size_t{20}}) {
    sensor_msgs::CompressedImage cut = message;
    cut.data.resize(size);
    EXPECT_NE(toDepth(cut).fault, "") << size;
  }
  const cv::Mat grey = cv::Mat::zeros(2, 2, CV_8UC1);
  EXPECT_NE(toDepth(compressedDepth("16UC1; compressedDepth", grey, 0.0F, 0.0F)).fault.find("16 bits"),
            std::string::npos);
}

}  // namespace
}  // namespace urban_nav_ros
