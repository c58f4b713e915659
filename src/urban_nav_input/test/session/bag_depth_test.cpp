// SPDX-License-Identifier: BSD-3-Clause
// Recordings with a depth camera and a planar laser.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>

#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;
using urban_nav_core::Pose;

constexpr int kDepthImages = 20;
constexpr double kDepthStart = 1.5e9, kDepthPeriod = 0.05;  // s
const Pose kMountedDepth(urban_nav_core::Quaterniond(0.5, -0.5, 0.5, -0.5), {0.3, 0.0, 0.8});

/// What differs from a recording that can be used.
struct DepthRecording {
  std::string encoding = "16UC1";
  bool has_info = true, has_tf = true;
  std::uint32_t info_width = 8;
  double distortion = 0.0;
};

sensor_msgs::Image depthAt(const ros::Time& stamp, const std::string& encoding) {
  sensor_msgs::Image image;
  image.header.stamp = stamp;
  image.header.frame_id = "depth_optical";
  image.encoding = encoding;
  image.width = 8;
  image.height = 6;
  image.step = 16;
  image.data.assign(image.step * image.height, 4);
  return image;
}

std::string writeDepth(const TemporaryFolder& folder, const DepthRecording& of = {}) {
  const std::string path = folder.file("depth.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage places;
  places.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "laser", Pose()));
  if (of.has_tf)
    places.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "depth_optical", kMountedDepth));
  bag.write("/tf_static", ros::Time(kDepthStart), places);
  for (int i = 0; i < kDepthImages; ++i) {
    const ros::Time stamp(kDepthStart + kDepthPeriod * i);
    bag.write("/camera/depth/image_rect_raw", stamp, depthAt(stamp, of.encoding));
    sensor_msgs::CameraInfo info;
    info.header.stamp = stamp;
    info.width = of.info_width;
    info.height = 6;
    info.K = {10, 0, 3.5, 0, 11, 2.5, 0, 0, 1};
    info.distortion_model = "plumb_bob";
    info.D.assign(5, of.distortion);
    info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    info.P = {10, 0, 3.5, 0, 0, 11, 2.5, 0, 0, 0, 1, 0};
    if (of.has_info) bag.write("/camera/depth/camera_info", stamp, info);
    sensor_msgs::LaserScan scan;
    scan.header.stamp = stamp;
    scan.header.frame_id = "laser";
    scan.angle_min = -1.0F;
    scan.angle_increment = 0.02F;
    scan.range_min = 0.1F;
    scan.range_max = 30.0F;
    scan.ranges.assign(100, 5.0F);
    if (i % 2 == 0) bag.write("/scan", stamp, scan);
  }
  return path;
}

struct ReadDepth {
  SourceInfo info;
  std::vector<DepthInput> images;
  bool hasNote(const std::string& text) const {
    return std::any_of(info.notes.begin(), info.notes.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
  }
};

ReadDepth readDepth(const std::string& path, bool with_depth = true) {
  SourceOptions options;
  options.with_sweeps = true;
  options.with_depth = with_depth;
  const std::unique_ptr<Source> source = openBags({path}, options);
  ReadDepth read;
  const auto take = [&read](const std::vector<DepthInput>& images) {
    read.images.insert(read.images.end(), images.begin(), images.end());
  };
  while (const std::optional<SourceItem> item = source->next()) {
    if (item->bag_end) take(item->bag_end->depths);
    take(item->depths);
  }
  if (source->bagEnd()) take(source->bagEnd()->depths);
  take(source->depths());
  read.info = source->info();
  return read;
}

TEST(BagDepth, ImagesComeOnceEachWithTheirCamera) {
  const TemporaryFolder folder;
  const ReadDepth read = readDepth(writeDepth(folder));
  ASSERT_EQ(read.info.depth_cameras.size(), 1U);
  const DepthCamera& camera = read.info.depth_cameras.front();
  EXPECT_EQ(camera.role, "depth0");
  EXPECT_EQ(camera.frame, "depth_optical");
  EXPECT_TRUE(isApprox(camera.T_base_camera, kMountedDepth, 1e-12));
  EXPECT_EQ(camera.pinhole.fy, 11.0);
  EXPECT_TRUE(read.hasNote("depth0: /camera/depth/image_rect_raw (guessed)"));
  ASSERT_EQ(read.images.size(), static_cast<std::size_t>(kDepthImages));
  for (std::size_t i = 0; i < read.images.size(); ++i) {
    EXPECT_NEAR(1e-9 * static_cast<double>(read.images[i].stamp), kDepthStart + kDepthPeriod * static_cast<double>(i),
                1e-6);
    ASSERT_TRUE(read.images[i].raw);
  }
  EXPECT_TRUE(readDepth(writeDepth(folder), false).images.empty());
}

TEST(BagDepth, ACameraThatCannotBeUsedIsNamedWithTheReason) {
  const TemporaryFolder folder;
  const auto expect = [&](const DepthRecording& of, const std::string& reason) {
    const ReadDepth read = readDepth(writeDepth(folder, of));
    EXPECT_TRUE(read.info.depth_cameras.empty()) << reason;
    EXPECT_TRUE(read.images.empty()) << reason;
    EXPECT_TRUE(read.hasNote("/camera/depth/image_rect_raw (depth0) is not used: " + reason)) << reason;
  };
  expect({"rgb8"}, "encoding rgb8");
  expect({"16UC1", false}, "it has no camera_info (--topic depth0_info:=NAME)");
  expect({"16UC1", true, false}, "no static tf from base_link to \"depth_optical\"");
  expect({"16UC1", true, true, 16}, "its images have 8x6 pixels");
}

TEST(BagDepth, DistortionThatIsNotCorrectedIsNamed) {
  const TemporaryFolder folder;
  const ReadDepth read = readDepth(writeDepth(folder, {"16UC1", true, true, 8, 0.1}));
  EXPECT_EQ(read.info.depth_cameras.size(), 1U);
  EXPECT_TRUE(read.hasNote("distortion in /camera/depth/camera_info is not corrected"));
}

}  // namespace
}  // namespace urban_nav_input
