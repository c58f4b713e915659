// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/pyramid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "support/opencv.hpp"

namespace urban_nav_core {
namespace {

cv::Mat drawImage(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  cv::Mat image(height, width, CV_8U);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random() & 255U);
  }
  return image;
}

int mirror(int i, int n) {
  while (i < 0 || i >= n) i = n == 1 ? 0 : (i < 0 ? -i : 2 * (n - 1) - i);
  return i;
}

/// The definition, pixel by pixel.
cv::Mat reduced(const cv::Mat& below) {
  const int weights[] = {1, 4, 6, 4, 1};
  cv::Mat image((below.rows + 1) / 2, (below.cols + 1) / 2, CV_8U);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      int sum = 128;
      for (int i = 0; i < 5; ++i) {
        for (int k = 0; k < 5; ++k) {
          sum += weights[i] * weights[k] *
                 below.at<std::uint8_t>(mirror(2 * v + i - 2, below.rows), mirror(2 * u + k - 2, below.cols));
        }
      }
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(sum >> 8);
    }
  }
  return image;
}

TEST(Pyramid, EveryPixelIsByTheDefinitionAtOddAndEvenSizes) {
  for (const auto& [width, height] :
       {std::pair{64, 48}, {65, 49}, {97, 33}, {161, 47}, {16, 16}, {31, 18}, {3, 2}, {1, 1}}) {
    cv::Mat expected = drawImage(width, height, static_cast<unsigned>(width));
    Pyramid pyramid(4);
    pyramid.build(view(expected));
    ASSERT_GE(pyramid.levels(), 1);
    for (int l = 0; l < pyramid.levels(); ++l) {
      if (l > 0) expected = reduced(expected);
      ASSERT_EQ(pyramid.level(l).width, expected.cols);
      ASSERT_EQ(pyramid.level(l).height, expected.rows);
      for (int v = 0; v < expected.rows; ++v) {
        for (int u = 0; u < expected.cols; ++u) {
          ASSERT_EQ(pyramid.level(l).at(u, v), expected.at<std::uint8_t>(v, u))
              << width << "x" << height << " level " << l << " at " << u << ", " << v;
        }
      }
    }
  }
}

TEST(Pyramid, AgreesWithOpenCv) {
  const cv::Mat image = drawImage(1241, 376, 5);
  Pyramid pyramid(3, 1241, 376);
  pyramid.build(view(image));
  ASSERT_EQ(pyramid.levels(), 3);
  cv::Mat expected = image;
  for (int l = 0; l < 3; ++l) {
    if (l > 0) cv::pyrDown(cv::Mat(expected), expected);
    const ImageView& level = pyramid.level(l);
    const cv::Mat actual(level.height, level.width, CV_8U, const_cast<std::uint8_t*>(level.data),
                         static_cast<std::size_t>(level.stride));
    EXPECT_EQ(cv::norm(actual, expected, cv::NORM_INF), 0.0) << "level " << l;
  }
}

TEST(Pyramid, AStructureAtUIsAtUOverTwoToTheLevel) {
  constexpr double kU0 = 127.3, kV0 = 86.6;
  cv::Mat image(192, 256, CV_8U);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const double r2 = (u - kU0) * (u - kU0) + (v - kV0) * (v - kV0);
      image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(250.0 * std::exp(-r2 / (2.0 * 12.0 * 12.0)));
    }
  }
  Pyramid pyramid(4);
  pyramid.build(view(image));
  ASSERT_EQ(pyramid.levels(), 4);
  for (int l = 0; l < 4; ++l) {
    double mass = 0.0, u_sum = 0.0, v_sum = 0.0;
    const ImageView& level = pyramid.level(l);
    for (int v = 0; v < level.height; ++v) {
      for (int u = 0; u < level.width; ++u) {
        mass += level.at(u, v);
        u_sum += u * level.at(u, v);
        v_sum += v * level.at(u, v);
      }
    }
    EXPECT_NEAR(u_sum / mass, kU0 * Pyramid::scale(l), 0.02) << "level " << l;
    EXPECT_NEAR(v_sum / mass, kV0 * Pyramid::scale(l), 0.02) << "level " << l;
  }
}

TEST(Pyramid, OwnsItsPixelsAndReadsThroughAStride) {
  cv::Mat wide = drawImage(200, 100, 7);
  const cv::Mat inside = wide(cv::Rect(13, 9, 101, 67));
  const cv::Mat copy = inside.clone();
  Pyramid pyramid(2);
  pyramid.build(view(inside));
  wide.setTo(0);
  EXPECT_EQ(pyramid.level(0).at(100, 66), copy.at<std::uint8_t>(66, 100));
  EXPECT_EQ(pyramid.level(1).at(50, 33), reduced(copy).at<std::uint8_t>(33, 50));
}

TEST(Pyramid, KeepsItsMemoryAndStopsAtSmallImages) {
  const cv::Mat a = drawImage(80, 60, 1), b = drawImage(80, 60, 2);
  Pyramid pyramid(6, 80, 60);
  pyramid.build(view(a));
  EXPECT_EQ(pyramid.levels(), 2) << "20 x 15 is below the smallest side";
  const std::uint8_t* first = pyramid.level(1).data;
  pyramid.build(view(b));
  EXPECT_EQ(pyramid.level(1).data, first);
  pyramid.build(ImageView{});
  EXPECT_EQ(pyramid.levels(), 0);
}

}  // namespace
}  // namespace urban_nav_core
