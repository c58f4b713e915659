// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/image.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace urban_nav_ros {
namespace {

sensor_msgs::Image message(const std::string& encoding, std::uint32_t width, std::uint32_t height,
                           std::vector<std::uint8_t> data, std::uint32_t step = 0) {
  sensor_msgs::Image image;
  image.encoding = encoding;
  image.width = width;
  image.height = height;
  image.step = step != 0 ? step : static_cast<std::uint32_t>(data.size() / height);
  image.data = std::move(data);
  return image;
}

TEST(ToGrey, SharesTheBytesOfMono8AndHeedsTheStep) {
  const sensor_msgs::Image image = message("mono8", 2, 2, {1, 2, 99, 3, 4, 99}, 3);
  const GreyImage grey = toGrey(image);
  ASSERT_TRUE(grey.fault.empty()) << grey.fault;
  EXPECT_EQ(grey.pixels.data, image.data.data());
  EXPECT_EQ(grey.pixels.at<std::uint8_t>(1, 0), 3);
}

TEST(ToGrey, WeighsColoursByTheirNames) {
  EXPECT_EQ(toGrey(message("rgb8", 1, 1, {255, 0, 0})).pixels.at<std::uint8_t>(0, 0), 76);
  EXPECT_EQ(toGrey(message("bgr8", 1, 1, {255, 0, 0})).pixels.at<std::uint8_t>(0, 0), 29);
  EXPECT_EQ(toGrey(message("rgba8", 1, 1, {255, 0, 0, 7})).pixels.at<std::uint8_t>(0, 0), 76);
  EXPECT_EQ(toGrey(message("bgra8", 1, 1, {255, 0, 0, 7})).pixels.at<std::uint8_t>(0, 0), 29);
}

TEST(ToGrey, FindsTheRedPixelOfAMosaic) {
  // Pure red light: the red pixels are bright, the others dark. Grey is 0.299 red if the pattern is interpreted
  // correctly.
  const auto mosaic = [](int red_u, int red_v) {
    std::vector<std::uint8_t> data(16 * 16, 0);
    for (int v = red_v; v < 16; v += 2) {
      for (int u = red_u; u < 16; u += 2) data[static_cast<std::size_t>(16 * v + u)] = 200;
    }
    return data;
  };
  EXPECT_NEAR(toGrey(message("bayer_rggb8", 16, 16, mosaic(0, 0))).pixels.at<std::uint8_t>(8, 8), 60, 1);
  EXPECT_NEAR(toGrey(message("bayer_bggr8", 16, 16, mosaic(1, 1))).pixels.at<std::uint8_t>(8, 8), 60, 1);
  EXPECT_NEAR(toGrey(message("bayer_grbg8", 16, 16, mosaic(1, 0))).pixels.at<std::uint8_t>(8, 8), 60, 1);
  EXPECT_NEAR(toGrey(message("bayer_gbrg8", 16, 16, mosaic(0, 1))).pixels.at<std::uint8_t>(8, 8), 60, 1);
}

TEST(ToGrey, TakesDeepPixelsByTheGivenScale) {
  sensor_msgs::Image image = message("mono16", 2, 1, {0xff, 0x0f, 0x00, 0x01});  // 4095 and 256
  EXPECT_EQ(toGrey(image, {0.0, 16.0}).pixels.at<std::uint8_t>(0, 0), 255);
  EXPECT_EQ(toGrey(image, {0.0, 16.0}).pixels.at<std::uint8_t>(0, 1), 16);
  EXPECT_EQ(toGrey(image, {256.0, 100.0}).pixels.at<std::uint8_t>(0, 1), 0);
  EXPECT_EQ(toGrey(image, kPixelsAsStored).pixels.at<std::uint8_t>(0, 1), 255) << "saturated, not wrapped";
  image = message("mono16", 2, 1, {0x0f, 0xff, 0x01, 0x00});
  image.is_bigendian = 1;
  EXPECT_EQ(toGrey(image, {0.0, 16.0}).pixels.at<std::uint8_t>(0, 0), 255);
  EXPECT_EQ(toGrey(image).pixels.at<std::uint8_t>(0, 1), 16) << "scaled by its own range";
}

TEST(ToGrey, TakesTheBrightnessOfYuv) {
  const cv::Mat uyvy = toGrey(message("yuv422", 2, 1, {1, 20, 3, 40})).pixels;
  EXPECT_EQ(uyvy.at<std::uint8_t>(0, 0), 20);
  EXPECT_EQ(uyvy.at<std::uint8_t>(0, 1), 40);
  const cv::Mat yuyv = toGrey(message("yuv422_yuy2", 2, 1, {20, 1, 40, 3})).pixels;
  EXPECT_EQ(yuyv.at<std::uint8_t>(0, 0), 20);
  EXPECT_EQ(yuyv.at<std::uint8_t>(0, 1), 40);
}

TEST(ToGrey, ReadsDeepColour) {
  // Red, little-endian, 12 of 16 bits.
  const sensor_msgs::Image red = message("rgb16", 1, 1, {0xff, 0x0f, 0, 0, 0, 0});
  EXPECT_NEAR(toGrey(red, {0.0, 16.0}).pixels.at<std::uint8_t>(0, 0), 0.299 * 255, 1.0);
  sensor_msgs::Image big = message("bgr16", 1, 1, {0, 0, 0, 0, 0x0f, 0xff});
  big.is_bigendian = 1;
  EXPECT_NEAR(toGrey(big, {0.0, 16.0}).pixels.at<std::uint8_t>(0, 0), 0.299 * 255, 1.0);
}

TEST(ToGrey, ReportsFaults) {
  EXPECT_NE(toGrey(message("32FC1", 1, 1, {1, 2, 3, 4})).fault.find("mono8"), std::string::npos)
      << "lists the supported encodings";
  EXPECT_FALSE(toGrey(message("mono8", 4, 4, std::vector<std::uint8_t>(15), 4)).fault.empty());
  EXPECT_FALSE(toGrey(message("mono8", 4, 1, std::vector<std::uint8_t>(4), 3)).fault.empty())
      << "step shorter than a row";
  EXPECT_FALSE(toGrey(message("mono8", 0, 1, {})).fault.empty());
  sensor_msgs::Image huge = message("mono8", 4, 1, {1, 2, 3, 4});
  huge.width = huge.step = 0xffffffff;
  EXPECT_FALSE(toGrey(huge).fault.empty());
}

TEST(ToGrey, DecodesWhatIsCompressed) {
  cv::Mat picture(8, 8, CV_8UC1);
  cv::randu(picture, 0, 255);
  sensor_msgs::CompressedImage compressed;
  cv::imencode(".png", picture, compressed.data);
  EXPECT_EQ(cv::norm(toGrey(compressed).pixels, picture, cv::NORM_INF), 0.0);
  compressed.data.resize(20);
  EXPECT_FALSE(toGrey(compressed).fault.empty());
  compressed.data.clear();
  EXPECT_FALSE(toGrey(compressed).fault.empty());
}

TEST(ToGrey, DemosaicsWhatWasCompressedAsAMosaic) {
  cv::Mat mosaic(16, 16, CV_8UC1, cv::Scalar(0));  // pure red light
  for (int v = 0; v < 16; v += 2)
    for (int u = 0; u < 16; u += 2) mosaic.at<std::uint8_t>(v, u) = 200;
  sensor_msgs::CompressedImage compressed;
  cv::imencode(".png", mosaic, compressed.data);
  for (const char* format :
       {"bayer_rggb8; png compressed", "bayer_rggb8; png compressed ", "bayer_rggb8; png compressed bayer_rggb8"}) {
    compressed.format = format;
    EXPECT_NEAR(toGrey(compressed).pixels.at<std::uint8_t>(8, 8), 60, 1) << format;
    const cv::Vec3b colour = toColour(compressed).pixels.at<cv::Vec3b>(8, 8);
    EXPECT_EQ(colour, cv::Vec3b(0, 0, 200)) << format;
  }
  for (const char* format : {"mono8; png compressed", "png", "bayer_rggb8; jpeg compressed mono8"}) {
    compressed.format = format;
    EXPECT_EQ(toGrey(compressed).pixels.at<std::uint8_t>(8, 8), 200) << format;
  }
}

TEST(ToImageMessage, ComesBackTheSame) {
  cv::Mat picture(5, 7, CV_8UC1);
  cv::randu(picture, 0, 255);
  const sensor_msgs::Image image = toImageMessage(picture(cv::Rect(1, 1, 5, 3)));
  EXPECT_EQ(image.step, 5U);
  EXPECT_EQ(cv::norm(toGrey(image).pixels, picture(cv::Rect(1, 1, 5, 3)), cv::NORM_INF), 0.0);
  EXPECT_TRUE(toView(cv::Mat()).empty());
  EXPECT_EQ(toView(picture).at(6, 4), picture.at<std::uint8_t>(4, 6));
}

}  // namespace
}  // namespace urban_nav_ros
