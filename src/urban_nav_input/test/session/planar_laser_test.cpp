// SPDX-License-Identifier: BSD-3-Clause
// Recordings with planar lasers alone, horizontal and not.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;
using urban_nav_core::Pose;
using urban_nav_core::Sweep;
using urban_nav_core::Vector3d;

constexpr double kScansStart = 1.5e9, kScanPeriod = 0.1;  // s
constexpr int kScanCount = 12;
constexpr std::size_t kScanBeams = 361;

/// A laser of a recording: its topic and frame, and its mounting, if the recording has one.
struct ScanTopic {
  std::string topic, frame;
  std::optional<Pose> T_base_laser;
  float time_increment = 2e-4F;  // s
};

sensor_msgs::LaserScan makeScan(const ScanTopic& laser, int number) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time(kScansStart + kScanPeriod * number);
  scan.header.frame_id = laser.frame;
  scan.angle_min = -3.0F;
  scan.angle_max = 3.0F;
  scan.angle_increment = 6.0F / (kScanBeams - 1);
  scan.time_increment = laser.time_increment;
  scan.scan_time = static_cast<float>(kScanPeriod);
  scan.range_min = 0.1F;
  scan.range_max = 30.0F;
  for (std::size_t k = 0; k < kScanBeams; ++k)
    scan.ranges.push_back(k % 50 == 7 ? HUGE_VALF : 4.0F + std::sin(0.05F * static_cast<float>(k)));
  return scan;
}

std::string writeScans(const TemporaryFolder& folder, const std::vector<ScanTopic>& lasers, bool with_images = false) {
  const std::string path = folder.file("scans.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage places;
  for (const ScanTopic& laser : lasers)
    if (laser.T_base_laser)
      places.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", laser.frame, *laser.T_base_laser));
  bag.write("/tf_static", ros::Time(kScansStart), places);
  for (int i = 0; i < kScanCount; ++i) {
    for (const ScanTopic& laser : lasers) {
      const sensor_msgs::LaserScan scan = makeScan(laser, i);
      bag.write(laser.topic, scan.header.stamp, scan);
    }
    for (const std::string side : {"left", "right"}) {
      if (!with_images) continue;
      sensor_msgs::Image image;
      image.header.stamp = ros::Time(kScansStart + kScanPeriod * i);
      image.header.frame_id = "camera";
      image.encoding = "mono8";
      image.width = image.step = 32;
      image.height = 24;
      image.data.assign(image.step * image.height, 100);
      sensor_msgs::CameraInfo info;
      info.header = image.header;
      info.width = 32;
      info.height = 24;
      info.P = {30, 0, 15.5, side == "right" ? -6.0 : 0.0, 0, 30, 11.5, 0, 0, 0, 1, 0};
      bag.write("/stereo/" + side + "/image_raw", image.header.stamp, image);
      bag.write("/stereo/" + side + "/camera_info", image.header.stamp, info);
    }
  }
  return path;
}

struct ReadScans {
  SourceInfo info;
  std::vector<SweepInput> sweeps;
  std::size_t scans = 0;
  std::vector<Finding> findings;
};

ReadScans readScans(const std::string& path, bool with_planar_sweeps = false,
                    const std::vector<std::string>& wishes = {}) {
  SourceOptions options;
  options.with_sweeps = true;
  options.with_planar_sweeps = with_planar_sweeps;
  options.topics = wishes;
  const std::unique_ptr<Source> source = openBags({path}, options);
  ReadScans read;
  const auto take = [&read](const std::vector<LaserInput>& scans, const std::vector<SweepInput>& sweeps) {
    read.scans += scans.size();
    read.sweeps.insert(read.sweeps.end(), sweeps.begin(), sweeps.end());
  };
  while (const std::optional<SourceItem> item = source->next()) take(item->scans, item->sweeps);
  take(source->scans(), source->sweeps());
  read.info = source->info();
  read.findings = source->sensorFindings();
  return read;
}

Pose mountedAt(const Vector3d& turn) { return Pose(urban_nav_core::expSo3(turn), {0.2, 0.0, 0.3}); }

bool hasNote(const SourceInfo& info, const std::string& text) {
  for (const std::string& note : info.notes)
    if (note.find(text) != std::string::npos) return true;
  return false;
}

std::string readFault(const std::string& path) {
  try {
    readScans(path);
  } catch (const urban_nav_core::DataError& error) {
    return error.what();
  }
  return "";
}

TEST(PlanarLaser, AHorizontalOneIsReadAsSweeps) {
  const TemporaryFolder folder;
  for (const Vector3d& turn : {Vector3d(0, 0, 0.5), Vector3d(M_PI, 0, 0), Vector3d(0.1, 0, 0)}) {
    const ReadScans read = readScans(writeScans(folder, {{"/scan", "laser", mountedAt(turn)}}));
    EXPECT_FALSE(read.info.has_images);
    EXPECT_EQ(read.info.planar_role, "laser0");
    EXPECT_EQ(read.info.frames, kScanCount);
    EXPECT_TRUE(hasNote(read.info, "planar motion only"));
    ASSERT_EQ(read.sweeps.size(), static_cast<std::size_t>(kScanCount));
    EXPECT_EQ(read.scans, read.sweeps.size());  // for the map
    const SweepInput& first = read.sweeps.front();
    EXPECT_TRUE(first.is_planar);
    EXPECT_EQ(first.role, "laser0");
    EXPECT_TRUE(isApprox(first.T_base_lidar, mountedAt(turn), 1e-12));
    EXPECT_EQ(first.sweep.times, Sweep::Times::Measured);
    EXPECT_NEAR(first.sweep.duration, 360 * 2e-4, 1e-7);
    EXPECT_NEAR(static_cast<double>(first.sweep.reference) * 1e-9 - kScansStart, 0.036, 1e-6);  // its middle
    EXPECT_EQ(first.sweep.beams.size(), kScanBeams - 8);
  }
}

TEST(PlanarLaser, WithoutTimesOfBeamsItsScansTakeThePeriod) {
  const TemporaryFolder folder;
  const ReadScans read = readScans(writeScans(folder, {{"/scan", "laser", mountedAt({0, 0, 0}), 0.0F}}));
  ASSERT_EQ(read.sweeps.size(), static_cast<std::size_t>(kScanCount));
  EXPECT_EQ(read.sweeps[1].sweep.times, Sweep::Times::Unknown);
  EXPECT_NEAR(read.sweeps[1].sweep.duration, kScanPeriod, 1e-6);
}

TEST(PlanarLaser, VerticalOnesAreRefusedWithTheReason) {
  const TemporaryFolder folder;
  const std::string fault =
      readFault(writeScans(folder, {{"/laser_left/scan", "laser_left", mountedAt({M_PI / 2, 0, 0})},
                                    {"/laser_right/scan", "laser_right", mountedAt({0, -M_PI / 2, 0})}}));
  EXPECT_NE(fault.find("/laser_left/scan by 90 deg"), std::string::npos) << fault;
  EXPECT_NE(fault.find("/laser_right/scan by 90 deg"), std::string::npos) << fault;
  EXPECT_NE(fault.find("none of their scans measures again what an earlier one did"), std::string::npos) << fault;
  const std::string tilted = readFault(writeScans(folder, {{"/scan", "laser", mountedAt({0.2, 0, 0})}}));
  EXPECT_NE(tilted.find("/scan by 11.5 deg"), std::string::npos) << tilted;
}

TEST(PlanarLaser, OneOfSeveralThatIsHorizontalIsUsed) {
  const TemporaryFolder folder;
  const std::string path = writeScans(folder, {{"/laser_left/scan", "laser_left", mountedAt({M_PI / 2, 0, 0})},
                                               {"/laser_right/scan", "laser_right", mountedAt({0, 0, 0})}});
  EXPECT_EQ(readScans(path).info.planar_role, "laser_right");
  EXPECT_EQ(readScans(path).scans, 2U * kScanCount);
}

TEST(PlanarLaser, WithoutTfItIsAssumedAtBaseLinkAndReported) {
  const TemporaryFolder folder;
  const ReadScans read = readScans(writeScans(folder, {{"/base_scan", "laser", std::nullopt}}));
  EXPECT_EQ(read.sweeps.size(), static_cast<std::size_t>(kScanCount));
  EXPECT_TRUE(hasNote(read.info, "base_link is assumed at this laser, which is assumed to be horizontal, /base_scan"));
  EXPECT_NE(readFault(writeScans(folder, {{"/laser_left/scan", "laser_left", std::nullopt}})), "");
}

TEST(PlanarLaser, OneThatNodsIsRefusedWithTheReason) {
  const TemporaryFolder folder;
  const std::string path = writeScans(folder, {{"/scan", "laser", std::nullopt}});
  {
    rosbag::Bag bag(path, rosbag::bagmode::Append);
    for (int i = 0; i < kScanCount; ++i) {
      tf2_msgs::TFMessage nod;
      nod.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "laser", mountedAt({0, 0.05 * i, 0})));
      nod.transforms[0].header.stamp = ros::Time(kScansStart + kScanPeriod * i);
      bag.write("/tf", nod.transforms[0].header.stamp, nod);
    }
  }
  const std::string fault = readFault(path);
  EXPECT_NE(fault.find("the transform to \"laser\" on /tf changes over time"), std::string::npos) << fault;
  EXPECT_NE(fault.find("nods or spins"), std::string::npos) << fault;
}

TEST(PlanarLaser, WithImagesItIsReadAsSweepsOnlyIfAskedFor) {
  const TemporaryFolder folder;
  const std::string path = writeScans(folder, {{"/scan", "laser", mountedAt({0, 0, 0})}}, true);
  const ReadScans unasked = readScans(path), asked = readScans(path, true);
  EXPECT_EQ(unasked.info.planar_role, "");
  EXPECT_TRUE(unasked.sweeps.empty());
  EXPECT_EQ(unasked.scans, static_cast<std::size_t>(kScanCount - 1)) << "for the map";
  EXPECT_TRUE(hasNote(unasked.info, "laser0: /scan (guessed)"));
  EXPECT_EQ(asked.info.planar_role, "laser0");
  EXPECT_EQ(asked.sweeps.size(), static_cast<std::size_t>(kScanCount - 1)) << "the last one follows the last pair";
  EXPECT_EQ(readScans(path, false, {"scan:=/scan"}).scans, unasked.scans) << "the name of the topic is a role too";
}

TEST(PlanarLaser, TheSideOfATiltedOneWithAnotherNameIsProposed) {
  const TemporaryFolder folder;
  const Pose vertical = mountedAt({M_PI / 2, 0, 0});
  const auto optionsWith = [&](const std::vector<ScanTopic>& lasers) {
    std::vector<std::string> options;
    for (const Finding& finding : readScans(writeScans(folder, lasers, true)).findings)
      if (finding.kind == FindingKind::Topics) options.push_back(finding.options.at(1));
    return options;
  };
  using Options = std::vector<std::string>;
  EXPECT_EQ(optionsWith({{"/scan", "a", vertical}, {"/scan_rear", "b", vertical}}),
            (Options{"laser_left:=/scan", "laser_right:=/scan_rear"}));
  EXPECT_EQ(optionsWith({{"/scan", "a", Pose(vertical.q(), {0.0, -0.2, 0.0})}}), Options{"laser_right:=/scan"});
  EXPECT_EQ(optionsWith({{"/scan", "a", vertical}, {"/laser_left/scan", "b", vertical}}),
            Options{"laser_right:=/scan"});
  EXPECT_EQ(optionsWith({{"/scan", "a", mountedAt({0, 0, 0})}}), Options()) << "a horizontal one has no side";
}

TEST(PlanarLaser, AllOfARobotAreReadForTheMap) {
  const TemporaryFolder folder;
  const std::string path = writeScans(folder,
                                      {{"/front/scan", "front", mountedAt({0, 0, 0})},
                                       {"/laser_left/scan", "laser_left", mountedAt({M_PI / 2, 0, 0})},
                                       {"/rear/scan", "rear", mountedAt({M_PI, 0, 0})},
                                       {"/scan", "push_broom", mountedAt({0, 1.0, 0})},
                                       {"/camera/depth/scan", "camera", mountedAt({0, 0, 0})}},
                                      true);
  const ReadScans read = readScans(path);
  EXPECT_EQ(read.scans, 4U * (kScanCount - 1)) << "not those that were computed from depth images";
  for (const char* note : {"laser0: /scan (guessed)", "laser1: /front/scan (guessed)", "laser2: /rear/scan (guessed)"})
    EXPECT_TRUE(hasNote(read.info, note)) << note;
  EXPECT_EQ(readScans(path, false, {"laser0:=/camera/depth/scan"}).scans, 5U * (kScanCount - 1));
}

}  // namespace
}  // namespace urban_nav_input
