// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/io/jpeg.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "urban_nav_core/testing/fuzz.hpp"

namespace urban_nav_registration {
namespace {

std::vector<std::uint8_t> somePicture() {
  std::vector<std::uint8_t> pixels(64 * 48);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(2 * (i % 64) + i / 64);
  return encodeJpeg({pixels.data(), 64, 48, 64}, 95);
}

TEST(Jpeg, ComesBackInItsOwnSizeAndInNoOther) {
  const std::vector<std::uint8_t> bytes = somePicture();
  const auto size = sizeOfJpeg(bytes);
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 64);
  EXPECT_EQ(size->height, 48);
  const cv::Mat pixels = decodeJpeg(bytes, {64, 48});
  ASSERT_FALSE(pixels.empty());
  EXPECT_NEAR(pixels.at<std::uint8_t>(20, 30), 80, 4);
  EXPECT_TRUE(decodeJpeg(bytes, {48, 64}).empty());
}

TEST(Jpeg, AWrongHeaderAllocatesNoMemory) {
  std::vector<std::uint8_t> bytes = somePicture();
  for (std::size_t i = 0; i + 9 < bytes.size(); ++i)
    if (bytes[i] == 0xFF && bytes[i + 1] == 0xC0)
      for (std::size_t k = 5; k < 9; ++k) bytes[i + k] = 0xFF;
  const auto size = sizeOfJpeg(bytes);
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 65535);
  EXPECT_TRUE(decodeJpeg(bytes, {64, 48}).empty());
}

TEST(Jpeg, WhatIsNoneIsNone) {
  EXPECT_FALSE(sizeOfJpeg({}));
  EXPECT_FALSE(sizeOfJpeg({0xFF, 0xD8}));
  EXPECT_FALSE(sizeOfJpeg({0xFF, 0xD8, 0xFF, 0xE0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_FALSE(sizeOfJpeg(std::vector<std::uint8_t>(100, 0xFF)));
  std::vector<std::uint8_t> bytes = somePicture();
  for (const std::size_t length : {std::size_t{10}, std::size_t{100}, bytes.size() / 2}) {
    bytes.resize(length);
    const cv::Mat pixels = decodeJpeg(bytes, {64, 48});  // a partial picture may be decoded, with grey for the missing
                                                         // part
    EXPECT_TRUE(pixels.empty() || (pixels.cols == 64 && pixels.rows == 48)) << length;
  }
}

TEST(Jpeg, Fuzzed) {
  const std::vector<std::uint8_t> bytes = somePicture();
  int decoded = 0;
  const auto result =
      urban_nav_core::testing::fuzzText({std::string(bytes.begin(), bytes.end())}, [&decoded](const std::string& text) {
        const std::vector<std::uint8_t> damaged(text.begin(), text.end());
        const auto size = sizeOfJpeg(damaged);
        EXPECT_TRUE(!size || std::min(size->width, size->height) > 0);
        if (++decoded > 300) return;  // libjpeg prints a warning for each
        const cv::Mat pixels = decodeJpeg(damaged, {64, 48});
        EXPECT_TRUE(pixels.empty() || (pixels.cols == 64 && pixels.rows == 48));
      });
  EXPECT_EQ(result.failure, "");
}

}  // namespace
}  // namespace urban_nav_registration
