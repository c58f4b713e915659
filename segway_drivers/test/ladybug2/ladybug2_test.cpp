// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "segway_drivers/ladybug2/frame.hpp"
#include "urban_nav_core/testing/fuzz.hpp"

namespace segway_drivers {
namespace {

void setBig32(Bytes& bytes, std::size_t at, std::uint32_t word) {
  Bytes four;
  appendBig32(four, word);
  std::copy(four.begin(), four.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

/// Frame whose planes are uniform: 10 (camera + 1) + slot.
Bytes makeLadybugFrame() {
  Bytes frame(0x400, 0);
  setBig32(frame, 0x00, 0xBB0E1600);
  setBig32(frame, 0x10, 0xCAFEBABE);
  setBig32(frame, 0x20, 4711);
  const std::string pattern = "BGGR";
  std::copy(pattern.begin(), pattern.end(), frame.begin() + 0x48);
  for (std::size_t camera = 0; camera < 6; ++camera)
    for (std::size_t slot = 0; slot < 4; ++slot) {
      std::vector<std::uint8_t> jpeg;
      cv::imencode(
          ".jpg",
          cv::Mat(384, 512, CV_8U, cv::Scalar(10.0 * static_cast<double>(camera + 1) + static_cast<double>(slot))),
          jpeg);
      setBig32(frame, 0x340 + 32 * camera + 8 * slot, static_cast<std::uint32_t>(frame.size()));
      setBig32(frame, 0x344 + 32 * camera + 8 * slot, static_cast<std::uint32_t>(jpeg.size()));
      frame.insert(frame.end(), jpeg.begin(), jpeg.end());
    }
  setBig32(frame, 0x08, static_cast<std::uint32_t>(frame.size()));
  return frame;
}

TEST(LadybugFrame, HeaderAndColours) {
  const Bytes bytes = makeLadybugFrame();
  const auto frame = splitLadybugFrame(bytes, false);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->sequence, 4711U);
  EXPECT_EQ(frame->bad_channels, 0);
  const cv::Mat image = decodeLadybugCamera(*frame, 2, *frame->pattern);
  ASSERT_EQ(image.size(), cv::Size(384, 512));
  const cv::Vec3b colour = image.at<cv::Vec3b>(100, 100);
  EXPECT_NEAR(colour[0], 30, 1);
  EXPECT_NEAR(colour[2], 33, 1);
  EXPECT_NEAR(decodeLadybugCamera(*splitLadybugFrame(bytes, true), 2, *frame->pattern).at<cv::Vec3b>(0, 0)[0], 40, 1);
}

TEST(LadybugFrame, ABadChannelCostsItsCameraOnly) {
  for (const std::uint32_t offset : {0U, 0x3FFU, 0x7FFFFF00U, 0xFFFFFFFFU}) {
    Bytes bytes = makeLadybugFrame();
    setBig32(bytes, 0x340 + 32 * 2 + 8, offset);
    const auto frame = splitLadybugFrame(bytes, false);
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->bad_channels, 1);
    EXPECT_TRUE(decodeLadybugCamera(*frame, 2, MosaicPattern::Bggr).empty());
    EXPECT_FALSE(decodeLadybugCamera(*frame, 3, MosaicPattern::Bggr).empty());
  }
}

TEST(LadybugFrame, DamagedHeadersAreRefused) {
  const Bytes bytes = makeLadybugFrame();
  // The header and the directory, cut before the images, keep the seeds small.
  Bytes small(bytes.begin(), bytes.begin() + 0x600);
  setBig32(small, 0x08, 0x600);
  const auto result =
      urban_nav_core::testing::fuzzText({std::string(small.begin(), small.end())}, [](const std::string& text) {
        const auto frame = splitLadybugFrame({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, false);
        if (frame) decodeLadybugCamera(*frame, 0, MosaicPattern::Bggr);
      });
  EXPECT_EQ(result.failure, "");
}

}  // namespace
}  // namespace segway_drivers
