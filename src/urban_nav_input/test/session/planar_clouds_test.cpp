// SPDX-License-Identifier: BSD-3-Clause
// Planar lasers that publish clouds: the same beams as from scans.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <cstring>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;
using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::Vector3d;

constexpr double kPlanarStart = 1.5e9;  // s

void writePairs(rosbag::Bag& bag) {
  sensor_msgs::Image image;
  image.header.frame_id = "camera";
  image.encoding = "mono8";
  image.width = image.step = 32;
  image.height = 24;
  image.data.assign(image.step * image.height, 100);
  sensor_msgs::CameraInfo info;
  info.width = 32;
  info.height = 24;
  for (int i = 0; i < 10; ++i)
    for (const bool is_right : {false, true}) {
      const std::string side = is_right ? "/stereo/right/" : "/stereo/left/";
      image.header.stamp = ros::Time(kPlanarStart + 0.1 * i);
      info.header = image.header;
      info.P = {30, 0, 15.5, is_right ? -6.0 : 0.0, 0, 30, 11.5, 0, 0, 0, 1, 0};
      bag.write(side + "image_raw", image.header.stamp, image);
      bag.write(side + "camera_info", image.header.stamp, info);
    }
}

sensor_msgs::LaserScan planarScan(double t, const std::string& frame) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = ros::Time(kPlanarStart + t);
  scan.header.frame_id = frame;
  scan.angle_min = -1.5F;
  scan.angle_increment = 0.02F;
  scan.angle_max = 1.5F;
  scan.time_increment = 4e-5F;
  scan.range_min = 0.1F;
  scan.range_max = 80.0F;
  for (int k = 0; k <= 150; ++k)
    scan.ranges.push_back(k % 9 == 4 ? HUGE_VALF : 6.0F + 2.0F * std::sin(0.1F * static_cast<float>(k + t)));
  return scan;
}

/// The cloud that a laser driver publishes in place of the scan: points that were measured, with times after the
/// header.
sensor_msgs::PointCloud2 toPlanarCloud(const sensor_msgs::LaserScan& scan) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header = scan.header;
  cloud.height = 1;
  cloud.point_step = 16;
  const char* names[] = {"x", "y", "z", "time"};
  for (std::uint32_t i = 0; i < 4; ++i) {
    sensor_msgs::PointField field;
    field.name = names[i];
    field.offset = 4 * i;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  for (std::size_t k = 0; k < scan.ranges.size(); ++k) {
    if (!std::isfinite(scan.ranges[k])) continue;
    const float angle = scan.angle_min + scan.angle_increment * static_cast<float>(k);
    const float point[] = {scan.ranges[k] * std::cos(angle), scan.ranges[k] * std::sin(angle), 0.0F,
                           scan.time_increment * static_cast<float>(k)};
    cloud.data.resize(cloud.data.size() + sizeof(point));
    std::memcpy(&cloud.data[cloud.data.size() - sizeof(point)], point, sizeof(point));
  }
  cloud.width = static_cast<std::uint32_t>(cloud.data.size() / cloud.point_step);
  cloud.row_step = static_cast<std::uint32_t>(cloud.data.size());
  return cloud;
}

std::string writeSession(const TemporaryFolder& folder, bool as_clouds) {
  const std::string path = folder.file(as_clouds ? "clouds.bag" : "scans.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage places;
  for (const auto& [frame, y] : {std::pair("laser_left", 0.2), std::pair("laser_right", -0.2)})
    places.transforms.push_back(
        urban_nav_ros::toStaticTransform("base_link", frame, Pose(Quaterniond::Identity(), Vector3d(0.0, y, 0.6))));
  bag.write("/tf_static", ros::Time(kPlanarStart), places);
  writePairs(bag);
  for (int i = 0; i < 20; ++i)
    for (const std::string side : {"left", "right"}) {
      const sensor_msgs::LaserScan scan = planarScan(0.045 * i, "laser_" + side);
      if (as_clouds) bag.write("/sick_" + side + "/cloud", scan.header.stamp, toPlanarCloud(scan));
      else bag.write("/laser_" + side + "/scan", scan.header.stamp, scan);
    }
  return path;
}

struct ReadSession {
  SourceInfo info;
  std::vector<LaserInput> scans;
  std::size_t sweeps = 0;
  std::vector<Finding> findings;
};

ReadSession readSession(const std::string& path, const std::vector<std::string>& wishes = {}) {
  SourceOptions options;
  options.with_sweeps = true;
  options.topics = wishes;
  const std::unique_ptr<Source> source = openBags({path}, options);
  ReadSession read;
  const auto take = [&read](const std::vector<LaserInput>& scans, const std::vector<SweepInput>& sweeps) {
    read.scans.insert(read.scans.end(), scans.begin(), scans.end());
    read.sweeps += sweeps.size();
  };
  while (const std::optional<SourceItem> item = source->next()) take(item->scans, item->sweeps);
  take(source->scans(), source->sweeps());
  read.info = source->info();
  read.findings = source->sensorFindings();
  return read;
}

TEST(PlanarClouds, GiveTheBeamsOfScans) {
  const TemporaryFolder folder;
  const ReadSession scans = readSession(writeSession(folder, false)), clouds = readSession(writeSession(folder, true));
  ASSERT_EQ(scans.info.lasers.size(), 2U);
  ASSERT_EQ(clouds.info.lasers.size(), 2U);
  EXPECT_EQ(clouds.sweeps, 0U);
  ASSERT_EQ(clouds.scans.size(), scans.scans.size());
  for (std::size_t i = 0; i < scans.scans.size(); ++i) {
    EXPECT_EQ(clouds.scans[i].laser, scans.scans[i].laser);
    ASSERT_EQ(clouds.scans[i].scan.beams.size(), scans.scans[i].scan.beams.size());
    for (std::size_t k = 0; k < scans.scans[i].scan.beams.size(); ++k) {
      const urban_nav_core::Beam &a = clouds.scans[i].scan.beams[k], &b = scans.scans[i].scan.beams[k];
      EXPECT_NEAR(static_cast<double>(a.stamp - b.stamp), 0.0, 2000.0);  // ns
      EXPECT_NEAR((a.range * a.direction - b.range * b.direction).norm(), 0.0F, 1e-3F);
    }
  }
  const auto named = [&](const std::string& text) {
    return std::count_if(clouds.findings.begin(), clouds.findings.end(),
                         [&](const Finding& finding) { return finding.text.find(text) != std::string::npos; });
  };
  EXPECT_EQ(named("/sick_left/cloud: PointCloud2 whose points lie in one plane, 1.15 deg between beams"), 1);
  EXPECT_EQ(named("its clouds are read as scans of laser_right"), 1);
}

TEST(PlanarClouds, AloneTheyAreNamedAsTheReasonThatThereIsNoPose) {
  const TemporaryFolder folder;
  const std::string path = folder.file("lasers.bag");
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    for (int i = 0; i < 20; ++i) {
      const sensor_msgs::LaserScan scan = planarScan(0.045 * i, "laser_left");
      bag.write("/scanner/cloud", scan.header.stamp, toPlanarCloud(scan));
    }
  }
  try {
    readSession(path);
    FAIL() << "no images, no sweeps";
  } catch (const urban_nav_core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find("/scanner/cloud: PointCloud2 whose points lie in one plane"),
              std::string::npos)
        << error.what();
  }
}

TEST(PlanarClouds, AWishMakesASweepOfACloud) {
  const TemporaryFolder folder;
  const ReadSession read = readSession(writeSession(folder, true), {"points0:=/sick_left/cloud"});
  EXPECT_EQ(read.info.lasers.size(), 1U);
  EXPECT_GT(read.sweeps, 0U);
}

}  // namespace
}  // namespace urban_nav_input
