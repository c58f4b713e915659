// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "segway_drivers/bumblebee2/factory_calibration.hpp"
#include "segway_drivers/bumblebee2/frame.hpp"
#include "segway_drivers/camera/bus_time.hpp"
#include "segway_drivers/camera/mosaic.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/testing/fuzz.hpp"

namespace segway_drivers {
namespace {

TEST(BusTime, TheWorkedExample) {
  EXPECT_NEAR(*parseBusTime(0xBB0E1600), 93.5401875, 1e-9);
  const TimeNs now = 1'000'000'000'000;
  EXPECT_EQ(hostTimeOfBusTime(93.5401875, 2.0125, now), now - 36'472'312'500);
  EXPECT_FALSE(parseBusTime(0x01FFFFFF));
}

TEST(Mosaic, UniformColoursSurviveDemosaicing) {
  const cv::Vec3b colour(30, 90, 200);  // B G R
  for (const char* const name : {"RGGB", "GBRG", "GRBG", "BGGR"}) {
    cv::Mat mosaic(16, 16, CV_8U), planes[4];
    for (int v = 0; v < 16; ++v)
      for (int u = 0; u < 16; ++u) {
        const char c = name[2 * (v % 2) + u % 2];
        mosaic.at<std::uint8_t>(v, u) = colour[c == 'B' ? 0 : c == 'G' ? 1 : 2];
      }
    const MosaicPattern pattern = *parseMosaicPattern(name);
    EXPECT_EQ(demosaic(mosaic, pattern).at<cv::Vec3b>(8, 8), colour) << name;
    for (int slot = 0; slot < 4; ++slot) {
      planes[slot] = cv::Mat(8, 8, CV_8U);
      for (int v = 0; v < 8; ++v)
        for (int u = 0; u < 8; ++u)
          planes[slot].at<std::uint8_t>(v, u) = mosaic.at<std::uint8_t>(2 * v + slot / 2, 2 * u + slot % 2);
    }
    EXPECT_EQ(combinePlanes(planes, pattern).at<cv::Vec3b>(4, 4), colour) << name;
  }
}

cv::Mat makeScene(int shift) {
  cv::Mat noise(kBb2Height / 4, kBb2Width / 4 + 32, CV_8U), scene;
  cv::RNG random(7);
  random.fill(noise, cv::RNG::UNIFORM, 0, 256);
  cv::resize(noise, scene, {}, 4.0, 4.0, cv::INTER_CUBIC);
  return scene(cv::Rect(shift, 0, kBb2Width, kBb2Height)).clone();
}

TEST(Bb2Frame, ImagersAreSeparatedAndOrderedByDisparity) {
  const cv::Mat left = makeScene(0), right = makeScene(12);
  Bytes raw(kBb2FrameSize);
  for (int v = 0; v < kBb2Height; ++v)
    for (int u = 0; u < kBb2Width; ++u) {
      const auto at = 2 * static_cast<std::size_t>(v * kBb2Width + u);
      raw[at] = right.at<std::uint8_t>(v, u);
      raw[at + 1] = left.at<std::uint8_t>(v, u);
    }
  const Bytes words = *parseHex("BB 0E 16 00 82 00 01 23 82 00 04 56 00 00 00 4D");
  std::copy(words.begin(), words.end(), raw.begin());
  const Bb2Frame frame = splitBb2Frame(raw, false, Bb2Embedding::Raw);
  EXPECT_NEAR(*frame.bus_time, 93.5401875, 1e-9);
  EXPECT_EQ(frame.sequence, 77U);
  EXPECT_EQ(frame.gain, 0x123);
  EXPECT_EQ(cv::countNonZero(frame.left.rowRange(1, kBb2Height) != left.rowRange(1, kBb2Height)), 0);
  EXPECT_EQ(medianDisparity(frame.left, frame.right), 12.0);
  const Bb2Frame swapped = splitBb2Frame(raw, true, Bb2Embedding::Raw);
  EXPECT_EQ(medianDisparity(swapped.left, swapped.right), -12.0);
  EXPECT_FALSE(medianDisparity(cv::Mat::zeros(480, 640, CV_8U), cv::Mat::zeros(480, 640, CV_8U)));
}

class FactoryCalibrationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* const folder = std::getenv("URBAN_NAV_DATA");
    if (folder == nullptr) GTEST_SKIP() << "URBAN_NAV_DATA is not set";
    path = std::string(folder) + "/devices/bumblebee2_cal/triclops.cal";
    text = urban_nav_core::readTextFile(path);
  }
  std::string path, text;
};

TEST_F(FactoryCalibrationTest, SurfacesOfARealCamera) {
  const FactoryCalibration calibration = parseFactoryCalibration(text, path);
  EXPECT_NEAR(calibration.fx * 1024, 819.45, 0.1);
  EXPECT_NEAR(calibration.baseline, 0.120022, 1e-9);
  EXPECT_NEAR(calibration.right.forward_x.at(0.25, 0.25), 0.244774, 1e-6);
  EXPECT_NEAR(calibration.right.forward_y.at(0.25, 0.25), 0.275439, 1e-6);
  EXPECT_NEAR(calibration.left.forward_x.at(0.9, 0.9), 0.868369, 1e-6);
  EXPECT_NEAR(calibration.left.forward_y.at(0.9, 0.9), 0.844918, 1e-6);
}

TEST_F(FactoryCalibrationTest, TheInverseSurfacesInvert) {
  const FactoryCalibration calibration = parseFactoryCalibration(text, path);
  for (const ImagerCalibration* imager : {&calibration.left, &calibration.right}) {
    double sum = 0.0;
    for (int i = 0; i < 41; ++i)
      for (int j = 0; j < 41; ++j) {
        const double x = i / 40.0, y = j / 40.0;
        const double raw_x = imager->forward_x.at(x, y), raw_y = imager->forward_y.at(x, y);
        const double dx = 1024 * (imager->inverse_x.at(raw_x, raw_y) - x),
                     dy = 768 * (imager->inverse_y.at(raw_x, raw_y) - y);
        EXPECT_LT(std::hypot(dx, dy), 1.7);
        sum += dx * dx + dy * dy;
      }
    EXPECT_LT(std::sqrt(sum / (41 * 41)), 0.11);
  }
}

TEST_F(FactoryCalibrationTest, MalformedTextIsRefused) {
  const auto result = urban_nav_core::testing::fuzzText({text}, [](const std::string& damaged) {
    const FactoryCalibration calibration = parseFactoryCalibration(damaged, "damaged.cal");
    EXPECT_TRUE(std::isfinite(calibration.left.forward_x.at(0.5, 0.5)));
  });
  EXPECT_EQ(result.failure, "");
}

}  // namespace
}  // namespace segway_drivers
