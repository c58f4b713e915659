// SPDX-License-Identifier: BSD-3-Clause
#include "device/simulate_camera.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Image.h>
#include <unistd.h>

#include <filesystem>

#include "segway_drivers/bumblebee2/frame.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

constexpr std::size_t kCameraPairs = 40;

std::uint8_t pixelOfCameraTest(std::size_t pair, bool left, std::size_t at) {
  return static_cast<std::uint8_t>(at / 640 + 3 * pair + (left ? 100 : 0));
}

sensor_msgs::Image makeCameraTestImage(std::size_t pair, bool left) {
  sensor_msgs::Image image;
  image.header.stamp = ros::Time(1000, 0) + ros::Duration(0.05 * static_cast<double>(pair));
  image.encoding = "mono8";
  image.width = image.step = 640;
  image.height = 480;
  image.data.resize(640 * 480);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = pixelOfCameraTest(pair, left, i);
  return image;
}

class SimulateCamera : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("simulate_camera_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    job_.kind = "bumblebee2";
    job_.bag = (folder_ / "session.bag").string();
    job_.source = (folder_ / "frames.raw").string();
    job_.truth = (folder_ / "truth.csv").string();
    rosbag::Bag bag(job_.bag, rosbag::bagmode::Write);
    for (std::size_t pair = 0; pair < kCameraPairs; ++pair)
      for (const bool left : {true, false}) {
        const sensor_msgs::Image image = makeCameraTestImage(pair, left);
        bag.write(left ? "/stereo/left/image_raw" : "/stereo/right/image_raw", image.header.stamp, image);
      }
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::int64_t simulate() const {
    return simulateCamera(job_, [] { return false; });
  }

  std::filesystem::path folder_;
  SimulateCameraJob job_;
};

TEST_F(SimulateCamera, FramesHoldTheImagesOfTheBagAndTheIndexTheirTimes) {
  ASSERT_EQ(simulate(), static_cast<std::int64_t>(kCameraPairs));
  const std::string raw = urban_nav_core::readBytes(job_.source);
  ASSERT_EQ(raw.size(), kCameraPairs * segway_drivers::kBb2FrameSize);
  const auto index = urban_nav_core::CsvTable::read(job_.source + ".csv");
  const auto truth = urban_nav_core::CsvTable::read(job_.truth);
  ASSERT_EQ(index.rows(), kCameraPairs);
  ASSERT_EQ(truth.rows(), kCameraPairs);
  for (std::size_t pair = 0; pair < kCameraPairs; ++pair) {
    const std::int64_t stamp = 1'000'000'000'000 + 50'000'000 * static_cast<std::int64_t>(pair);
    EXPECT_EQ(truth.integer(pair, truth.column("true_ns")), stamp);
    EXPECT_GT(index.integer(pair, index.column("arrival_ns")), stamp);
    EXPECT_EQ(index.integer(pair, index.column("sequence")), static_cast<std::int64_t>(pair));
    const auto offset = static_cast<std::size_t>(index.integer(pair, index.column("offset")));
    ASSERT_EQ(offset, pair * segway_drivers::kBb2FrameSize);
    const segway_drivers::ByteView bytes(reinterpret_cast<const std::uint8_t*>(raw.data()) + offset,
                                         segway_drivers::kBb2FrameSize);
    const auto frame = segway_drivers::splitBb2Frame(bytes, false, segway_drivers::Bb2Embedding::Raw);
    const std::size_t at = 77 * 640 + 5;
    EXPECT_EQ(frame.left.at<std::uint8_t>(77, 5), pixelOfCameraTest(pair, true, at));
    EXPECT_EQ(frame.right.at<std::uint8_t>(77, 5), pixelOfCameraTest(pair, false, at));
  }
}

TEST_F(SimulateCamera, ASessionIsSimulatedWhereThereIsNoBag) {
  job_.bag.clear();
  job_.session.duration = 0.2;
  EXPECT_EQ(simulate(), 4);
  EXPECT_EQ(urban_nav_core::readBytes(job_.source).size(), 4 * segway_drivers::kBb2FrameSize);
  job_.kind = "ladybug2";
  EXPECT_EQ(simulate(), 1);
}

TEST_F(SimulateCamera, TheSameJobGivesTheSameBytes) {
  job_.options.faults = {urban_nav_sim::parseDeviceFault("unplug:0.5:0.5")};
  EXPECT_NEAR(static_cast<double>(simulate()), 30.0, 1.0);
  const std::string first = urban_nav_core::readBytes(job_.source);
  simulate();
  EXPECT_TRUE(first == urban_nav_core::readBytes(job_.source));
}

TEST_F(SimulateCamera, FaultsOfSerialDevicesAndBagsWithoutImagesAreRefused) {
  job_.options.faults = {urban_nav_sim::parseDeviceFault("baud:1:1")};
  EXPECT_THROW(simulate(), urban_nav_core::UserError);
  job_.options.faults.clear();
  job_.kind = "ladybug2";
  EXPECT_THROW(simulate(), urban_nav_core::UserError);
  job_.bag = (folder_ / "none.bag").string();
  EXPECT_THROW(simulate(), urban_nav_core::UserError);
  EXPECT_FALSE(std::filesystem::exists(job_.source));
}

}  // namespace
}  // namespace urban_nav
