// SPDX-License-Identifier: BSD-3-Clause
// Recordings with cameras that colour the map.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;
using urban_nav_core::Pose;

constexpr int kColourImages = 12;
constexpr double kColourStart = 1.5e9, kColourPeriod = 0.05;  // s
const Pose kMountedColour(urban_nav_core::Quaterniond(0.5, -0.5, 0.5, -0.5), {0.3, 0.1, 0.8});
const std::string kColourTopic = "/camera/color/image_raw";

/// Differences from a recording whose camera can be used.
struct ColourRecording {
  std::string encoding = "rgb8";
  bool has_info = true, has_tf = true;
  std::uint32_t info_width = 8;
  std::string model = "plumb_bob";
  std::string image_topic = kColourTopic;
};

sensor_msgs::Image imageAt(const ros::Time& stamp, const std::string& encoding, const std::string& frame) {
  sensor_msgs::Image image;
  image.header.stamp = stamp;
  image.header.frame_id = frame;
  image.encoding = encoding;
  image.width = 8;
  image.height = 6;
  image.step = 8 * (encoding == "mono8" || encoding.compare(0, 5, "bayer") == 0 ? 1 : encoding == "yuv422" ? 2 : 3);
  image.data.assign(image.step * image.height, 90);
  return image;
}

sensor_msgs::CameraInfo infoAt(const ros::Time& stamp, double offset = 0.0) {
  sensor_msgs::CameraInfo info;
  info.header.stamp = stamp;
  info.width = 8;
  info.height = 6;
  info.K = {10, 0, 3.5, 0, 11, 2.5, 0, 0, 1};
  info.distortion_model = "plumb_bob";
  info.D = {0.1, 0.02, 0, 0, 0};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {10, 0, 3.5, offset, 0, 11, 2.5, 0, 0, 0, 1, 0};
  return info;
}

std::string writeColour(const TemporaryFolder& folder, const ColourRecording& of = {}) {
  const std::string path = folder.file("colour.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage places;
  places.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "laser", Pose()));
  if (of.has_tf) places.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "colour", kMountedColour));
  bag.write("/tf_static", ros::Time(kColourStart), places);
  for (int i = 0; i < kColourImages; ++i) {
    const ros::Time stamp(kColourStart + kColourPeriod * i);
    bag.write(of.image_topic, stamp, imageAt(stamp, of.encoding, "colour"));
    sensor_msgs::CameraInfo info = infoAt(stamp);
    info.width = of.info_width;
    info.distortion_model = of.model;
    if (of.model == "equidistant") info.D = {0.1, 0.02, 0.01, 0.003};
    if (of.has_info) bag.write("/camera/color/camera_info", stamp, info);
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

struct ReadColour {
  SourceInfo info;
  std::vector<ColourInput> images;
  bool hasNote(const std::string& text) const {
    return std::any_of(info.notes.begin(), info.notes.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
  }
};

ReadColour readColour(const std::string& path, const std::vector<std::string>& topics = {}, bool with_colour = true) {
  SourceOptions options;
  options.topics = topics;
  options.with_sweeps = true;
  options.with_colour = with_colour;
  const std::unique_ptr<Source> source = openBags({path}, options);
  ReadColour read;
  const auto take = [&read](const std::vector<ColourInput>& images) {
    read.images.insert(read.images.end(), images.begin(), images.end());
  };
  while (const std::optional<SourceItem> item = source->next()) {
    if (item->bag_end) take(item->bag_end->colours);
    take(item->colours);
  }
  if (source->bagEnd()) take(source->bagEnd()->colours);
  take(source->colours());
  read.info = source->info();
  return read;
}

TEST(BagColour, ImagesComeOnceEachWithTheirCamera) {
  const TemporaryFolder folder;
  for (const char* encoding : {"rgb8", "bgr8", "bayer_grbg8", "yuv422"}) {
    const ReadColour read = readColour(writeColour(folder, {encoding}));
    ASSERT_EQ(read.info.colour_cameras.size(), 1U) << encoding;
    const ColourCamera& camera = read.info.colour_cameras.front();
    EXPECT_EQ(camera.role, "colour0");
    EXPECT_EQ(camera.frame, "colour");
    EXPECT_TRUE(isApprox(camera.T_base_camera, kMountedColour, 1e-12));
    EXPECT_EQ(camera.camera.pinhole.fy, 11.0);
    EXPECT_EQ(camera.camera.distortion.coefficients()[1], 0.02);
    EXPECT_TRUE(read.hasNote("colour0: /camera/color/image_raw (guessed)"));
    ASSERT_EQ(read.images.size(), static_cast<std::size_t>(kColourImages));
    for (std::size_t i = 0; i < read.images.size(); ++i) {
      EXPECT_NEAR(1e-9 * static_cast<double>(read.images[i].stamp),
                  kColourStart + kColourPeriod * static_cast<double>(i), 1e-6);
      EXPECT_TRUE(read.images[i].image.hasColour());
    }
  }
  EXPECT_TRUE(readColour(writeColour(folder), {}, false).images.empty());
}

TEST(BagColour, AFisheyeKeepsItsModel) {
  const TemporaryFolder folder;
  ColourRecording of;
  of.model = "equidistant";
  const ReadColour read = readColour(writeColour(folder, of));
  ASSERT_EQ(read.info.colour_cameras.size(), 1U);
  EXPECT_TRUE(read.info.colour_cameras.front().camera.distortion.isEquidistant());
}

TEST(BagColour, RectifiedImagesHaveNoDistortion) {
  const TemporaryFolder folder;
  ColourRecording of;
  of.image_topic = "/camera/color/image_rect_color";
  const ReadColour read = readColour(writeColour(folder, of));
  ASSERT_EQ(read.info.colour_cameras.size(), 1U);
  EXPECT_TRUE(read.info.colour_cameras.front().camera.distortion.isNone());
}

TEST(BagColour, ACameraThatCannotBeUsedIsNamedWithTheReason) {
  const TemporaryFolder folder;
  const auto expect = [&](const ColourRecording& of, const std::string& reason) {
    const ReadColour read = readColour(writeColour(folder, of), {"colour0:=" + of.image_topic});
    EXPECT_TRUE(read.info.colour_cameras.empty()) << reason;
    EXPECT_TRUE(read.images.empty()) << reason;
    EXPECT_TRUE(read.hasNote(of.image_topic + " (colour0) does not colour the map: " + reason)) << reason;
  };
  expect({"mono8"}, "its images are grey");
  expect({"rgb8", false}, "it has no camera_info (--topic colour0_info:=NAME)");
  expect({"rgb8", true, false}, "no static tf from base_link to \"colour\"");
  expect({"rgb8", true, true, 16}, "its images have 8x6 pixels, /camera/color/camera_info is of 16x6");
}

/// A stereo pair of one encoding, with a static transform.
std::string writeStereo(const TemporaryFolder& folder, const std::string& encoding) {
  const std::string path = folder.file("stereo.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage places;
  places.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "left", kMountedColour));
  bag.write("/tf_static", ros::Time(kColourStart), places);
  for (int i = 0; i < kColourImages; ++i) {
    const ros::Time stamp(kColourStart + kColourPeriod * i);
    bag.write("/stereo/left/image_raw", stamp, imageAt(stamp, encoding, "left"));
    bag.write("/stereo/right/image_raw", stamp, imageAt(stamp, encoding, "right"));
    bag.write("/stereo/left/camera_info", stamp, infoAt(stamp));
    bag.write("/stereo/right/camera_info", stamp, infoAt(stamp, -1.2));
  }
  return path;
}

TEST(BagColour, TheLeftCameraColoursTheMapIfNoOtherDoes) {
  const TemporaryFolder folder;
  const ReadColour read = readColour(writeStereo(folder, "bgr8"));
  ASSERT_EQ(read.info.colour_cameras.size(), 1U);
  const ColourCamera& camera = read.info.colour_cameras.front();
  EXPECT_EQ(camera.role, "left");
  EXPECT_TRUE(isApprox(camera.T_base_camera, kMountedColour, 1e-9));
  EXPECT_EQ(camera.camera.distortion.coefficients()[0], 0.1) << "raw images";
  EXPECT_EQ(read.images.size(), static_cast<std::size_t>(kColourImages));
  EXPECT_TRUE(readColour(writeStereo(folder, "mono8")).info.colour_cameras.empty());
}

/// Returns the topic chosen for a role; empty without one.
std::string chosen(const std::map<std::string, std::string>& available, Role role) {
  const auto topic = chooseTopics(available, {}).find(role);
  return topic ? topic->name : std::string();
}

TEST(BagColour, TopicsAreGuessedByNamespaceAndName) {
  const std::string raw = "sensor_msgs/Image", packed = "sensor_msgs/CompressedImage", info = "sensor_msgs/CameraInfo";
  const std::map<std::string, std::string> stereo = {{"/stereo/left/image_raw", raw},
                                                     {"/stereo/left/camera_info", info},
                                                     {"/stereo/right/image_raw", raw},
                                                     {"/stereo/right/camera_info", info}};
  std::map<std::string, std::string> topics = stereo;
  EXPECT_EQ(chosen(topics, Role::Colour0), "");
  topics.insert({{"/a/image_raw", raw}, {"/a/camera_info", info}});
  EXPECT_EQ(chosen(topics, Role::Colour0), "/a/image_raw");
  topics.insert({{"/b/rgb/image_raw", raw}, {"/b/rgb/image_raw/compressed", packed}, {"/b/rgb/camera_info", info}});
  EXPECT_EQ(chosen(topics, Role::Colour0), "/b/rgb/image_raw/compressed") << "named after colours; cheaper to read";
  EXPECT_EQ(chosen(topics, Role::Colour0Info), "/b/rgb/camera_info");
  EXPECT_EQ(chosen(topics, Role::Colour1), "/a/image_raw");
  EXPECT_EQ(chosen(topics, Role::Left), "/stereo/left/image_raw");
  topics = stereo;
  topics.insert({{"/stereo/left/image_color", raw}, {"/stereo/right/image_color", raw}});
  EXPECT_EQ(chosen(topics, Role::Colour0), "/stereo/left/image_color");
  EXPECT_EQ(chosen(topics, Role::Colour1), "") << "one camera of the pair is enough";
  topics = stereo;
  topics.insert({{"/stereo/left/debug_color", raw},
                 {"/tracker/matches/image_color", raw},
                 {"/tracker/matches/camera_info", info},
                 {"/camera/infra1/image_rect_raw", raw},
                 {"/camera/infra1/camera_info", info},
                 {"/x/color/image_raw", raw}});
  EXPECT_EQ(chosen(topics, Role::Colour0), "") << "computed, without colour, without camera_info";
}

}  // namespace
}  // namespace urban_nav_input
