// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/harris.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "support/opencv.hpp"

namespace urban_nav_core {
namespace {

cv::Mat randomImage(int width, int height, unsigned seed) {
  cv::Mat image(height, width, CV_8U);
  std::mt19937 random(seed);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(random() & 255U);
  }
  return image;
}

StructureTensor plain(const cv::Mat& image, int u, int v) {
  double uu = 0.0, uv = 0.0, vv = 0.0;
  for (int i = v - 3; i <= v + 3; ++i) {
    for (int k = u - 3; k <= u + 3; ++k) {
      const auto at = [&](int dv, int du) { return static_cast<double>(image.at<std::uint8_t>(i + dv, k + du)); };
      const double du = (at(-1, 1) - at(-1, -1) + 2 * (at(0, 1) - at(0, -1)) + at(1, 1) - at(1, -1)) / 8;
      const double dv = (at(1, -1) - at(-1, -1) + 2 * (at(1, 0) - at(-1, 0)) + at(1, 1) - at(-1, 1)) / 8;
      uu += du * du / 49;
      uv += du * dv / 49;
      vv += dv * dv / 49;
    }
  }
  return {static_cast<float>(uu), static_cast<float>(uv), static_cast<float>(vv)};
}

TEST(Harris, IsThePlainSumEverywhereUpToTheMargin) {
  // The copy ends with its last pixel, so that the address sanitizer detects reads beyond it.
  const cv::Mat image = randomImage(29, 21, 3);
  std::vector<std::uint8_t> exact(image.datastart, image.dataend);
  const ImageView tight{exact.data(), 29, 21, 29};
  for (int v = kHarrisMargin; v < 21 - kHarrisMargin; ++v) {
    for (int u = kHarrisMargin; u < 29 - kHarrisMargin; ++u) {
      const StructureTensor expected = plain(image, u, v), actual = structureTensor(tight, u, v);
      ASSERT_NEAR(actual.uu, expected.uu, 1e-5F * expected.uu);
      ASSERT_NEAR(actual.uv, expected.uv, 1e-5F * expected.uu);
      ASSERT_NEAR(actual.vv, expected.vv, 1e-5F * expected.vv);
    }
  }
}

TEST(Harris, AgreesWithOpenCv) {
  cv::Mat image = randomImage(120, 90, 4), expected;
  cv::GaussianBlur(image, image, cv::Size(), 1.5);
  cv::cornerHarris(image, expected, 7, 3, kHarrisK);
  // OpenCV scales the gradients by 1 / (4 * 7 * 255) before it sums over the window.
  const double scale = std::pow(4.0 * 7.0 * 255.0 / 8.0 / 7.0, 4);
  for (int v = 10; v < 80; v += 7) {
    for (int u = 10; u < 110; u += 7) {
      const double reference = expected.at<float>(v, u) * scale;
      EXPECT_NEAR(structureTensor(view(image), u, v).harris(), reference, 1e-3 * std::abs(reference) + 1e-2);
    }
  }
}

TEST(Harris, CornersArePositiveEdgesNegativeNothingIsZero) {
  cv::Mat image(40, 40, CV_8U, cv::Scalar(40));
  image(cv::Rect(20, 20, 20, 20)).setTo(200);
  EXPECT_GT(structureTensor(view(image), 20, 20).harris(), 1e3F);
  EXPECT_LT(structureTensor(view(image), 20, 33).harris(), -1e3F);
  EXPECT_EQ(structureTensor(view(image), 8, 8).harris(), 0.0F);
}

TEST(Harris, HoldsTheSteepestContrast) {
  cv::Mat image(16, 16, CV_8U);
  for (int v = 0; v < 16; ++v) {
    for (int u = 0; u < 16; ++u) image.at<std::uint8_t>(v, u) = ((u / 2 + v / 2) % 2) != 0 ? 255 : 0;
  }
  const StructureTensor expected = plain(image, 8, 8), actual = structureTensor(view(image), 8, 8);
  EXPECT_NEAR(actual.uu, expected.uu, 1e-5F * expected.uu);
  EXPECT_NEAR(actual.vv, expected.vv, 1e-5F * expected.vv);
}

}  // namespace
}  // namespace urban_nav_core
