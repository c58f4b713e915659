// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/bag_topics.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {
namespace {

using Topics = std::map<std::string, std::string>;
const char* const kImage = "sensor_msgs/Image";
const char* const kCompressed = "sensor_msgs/CompressedImage";
const char* const kInfo = "sensor_msgs/CameraInfo";

std::string name(const BagTopics& topics, Role role) { return topics.find(role) ? topics.find(role)->name : "none"; }

TEST(BagTopics, TakesTheSuitesOwnNames) {
  const BagTopics topics = chooseTopics({{"/stereo/left/image_raw", kImage},
                                         {"/stereo/right/image_raw", kImage},
                                         {"/stereo/left/image_rect", kImage},
                                         {"/stereo/right/image_rect", kImage},
                                         {"/stereo/left/camera_info", kInfo},
                                         {"/stereo/right/camera_info", kInfo},
                                         {"/ladybug/camera0/image_raw/compressed", kCompressed},
                                         {"/ladybug/camera1/image_raw/compressed", kCompressed},
                                         {"/imu/data", "sensor_msgs/Imu"},
                                         {"/wheel_odom", "nav_msgs/Odometry"},
                                         {"/vo/odometry", "nav_msgs/Odometry"},
                                         {"/ground_truth/pose", "geometry_msgs/PoseStamped"}},
                                        {});
  EXPECT_EQ(name(topics, Role::Left), "/stereo/left/image_raw");
  EXPECT_EQ(name(topics, Role::Right), "/stereo/right/image_raw");
  EXPECT_EQ(name(topics, Role::LeftInfo), "/stereo/left/camera_info");
  EXPECT_EQ(name(topics, Role::RightInfo), "/stereo/right/camera_info");
  EXPECT_EQ(name(topics, Role::Imu), "/imu/data");
  EXPECT_EQ(name(topics, Role::Wheels), "/wheel_odom");
  EXPECT_EQ(name(topics, Role::Truth), "/ground_truth/pose");
  EXPECT_EQ(topics.panorama().size(), 2U);
  EXPECT_EQ(topics.notes.size(), 9U);
}

TEST(BagTopics, GuessesOtherPeoplesNames) {
  for (const auto& [left, right, type] :
       {std::tuple("/cam0/image_raw", "/cam1/image_raw", kImage),
        std::tuple("/camera/infra1/image_rect_raw", "/camera/infra2/image_rect_raw", kImage),
        std::tuple("/zed/left/image_rect_color/compressed", "/zed/right/image_rect_color/compressed", kCompressed),
        std::tuple("kitti/image_00", "kitti/image_01", kImage)}) {
    const BagTopics topics = chooseTopics({{left, type}, {right, type}, {"/other/image", kImage}}, {});
    EXPECT_EQ(name(topics, Role::Left), left);
    EXPECT_EQ(name(topics, Role::Right), right);
    EXPECT_EQ(name(topics, Role::LeftInfo), "none");
  }
}

TEST(BagTopics, TakesTheOnlyTwoImagesWhateverTheirNames) {
  const Topics two = {{"/cam_1/image_raw", kImage}, {"/cam_2/image_raw", kImage}, {"/cam_2/camera_info", kInfo}};
  EXPECT_EQ(name(chooseTopics(two, {}), Role::Left), "/cam_1/image_raw");
  EXPECT_EQ(name(chooseTopics(two, {}), Role::Right), "/cam_2/image_raw");
  EXPECT_EQ(name(chooseTopics(two, {}), Role::RightInfo), "/cam_2/camera_info");
  EXPECT_EQ(name(chooseTopics(two, {"left:=/cam_2/image_raw"}), Role::Right), "/cam_1/image_raw");
  EXPECT_EQ(name(chooseTopics(two, {"right:=/cam_1/image_raw"}), Role::Left), "/cam_2/image_raw");
  for (const Topics& none : {Topics{{"/a", kImage}}, Topics{{"/a", kImage}, {"/b", kImage}, {"/c", kImage}},
                             Topics{{"/a", kImage}, {"/a/compressed", kCompressed}},
                             Topics{{"/a/image_raw", kImage}, {"/a/image_rect", kImage}},
                             Topics{{"/a/image_raw", kImage}, {"/a/depth", kImage}}})
    EXPECT_EQ(name(chooseTopics(none, {}), Role::Left), "none");
}

TEST(BagTopics, FindsCameraInfoAboveCompressedImages) {
  const BagTopics topics = chooseTopics({{"/a/left/image_raw/compressed", kCompressed},
                                         {"/a/right/image_raw/compressed", kCompressed},
                                         {"/a/left/camera_info", kInfo},
                                         {"/a/right/camera_info", kInfo}},
                                        {});
  EXPECT_EQ(name(topics, Role::LeftInfo), "/a/left/camera_info");
}

TEST(BagTopics, TakesTheOnlyTwoCameraInfosOfAnyName) {
  const Topics images = {{"/left/image_raw", kImage}, {"/right/image_raw", kImage}};
  const auto with = [&](std::vector<std::string> infos) {
    Topics all = images;
    for (const std::string& info : infos) all[info] = kInfo;
    const BagTopics topics = chooseTopics(all, {});
    return name(topics, Role::LeftInfo) + " " + name(topics, Role::RightInfo);
  };
  EXPECT_EQ(with({"/l/info", "/r/info"}), "/l/info /r/info");
  EXPECT_EQ(with({"/calibration/a_left", "/calibration/a_right"}), "/calibration/a_left /calibration/a_right");
  EXPECT_EQ(with({"/info"}), "none none");
  EXPECT_EQ(with({"/a/info", "/b/info", "/c/info"}), "none none");
}

TEST(BagTopics, FindsAPanoramicHeadAndTakesItForNoStereoPair) {
  std::map<std::string, std::string> available;
  for (const char* number : {"0", "1", "2", "3", "4"}) {
    available["/ladybug/camera" + std::string(number) + "/image_raw/compressed"] = kCompressed;
    available["/ladybug/camera" + std::string(number) + "/camera_info"] = kInfo;
  }
  const BagTopics alone = chooseTopics(available, {});
  EXPECT_EQ(alone.panorama(), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(name(alone, Role::Panorama3), "/ladybug/camera3/image_raw/compressed");
  EXPECT_EQ(name(alone, Role::Panorama3Info), "/ladybug/camera3/camera_info");
  EXPECT_EQ(name(alone, Role::Left), "none");
  available["/stereo/left/image_raw"] = available["/stereo/right/image_raw"] = kImage;
  const BagTopics with_stereo = chooseTopics(available, {});
  EXPECT_EQ(name(with_stereo, Role::Left), "/stereo/left/image_raw");
  EXPECT_EQ(with_stereo.panorama().size(), 5U);
  available["/gopro"] = kImage;
  const BagTopics single = chooseTopics(available, {"panorama0:=/gopro"});
  EXPECT_EQ(single.panorama(), std::vector<std::size_t>{0});
  EXPECT_EQ(name(single, Role::Panorama0), "/gopro");
}

TEST(BagTopics, TakesNoPanoramicHeadFromASingleCamera) {
  const BagTopics topics = chooseTopics({{"/panorama/camera0/image_raw", kImage}}, {});
  EXPECT_TRUE(topics.panorama().empty());
}

TEST(BagTopics, DoesAsItIsAsked) {
  const Topics available = {{"/stereo/left/image_raw", kImage},
                            {"/stereo/right/image_raw", kImage},
                            {"/stereo/left/image_rect", kImage},
                            {"/stereo/right/image_rect", kImage},
                            {"/p", "geometry_msgs/PoseStamped"}};
  EXPECT_EQ(name(chooseTopics(available, {"left:=stereo/left/image_rect"}), Role::Right), "/stereo/right/image_rect")
      << "the partner follows";
  EXPECT_EQ(name(chooseTopics(available, {"ground_truth/pose:=/p"}), Role::Truth), "/p");
  EXPECT_THROW(chooseTopics(available, {"left:=/nowhere"}), urban_nav_core::UserError);
  EXPECT_THROW(chooseTopics(available, {"left:=/p"}), urban_nav_core::UserError) << "no image";
  EXPECT_THROW(chooseTopics(available, {"middle:=/p"}), urban_nav_core::UserError);
  EXPECT_THROW(chooseTopics(available, {"left=/p"}), urban_nav_core::UserError);
}

TEST(BagTopics, FindsOneStreamOfEachDepthCamera) {
  const Topics available = {{"/camera/aligned_depth_to_color/image_raw", kImage},
                            {"/camera/aligned_depth_to_color/camera_info", kInfo},
                            {"/camera/depth/image_rect_raw", kImage},
                            {"/camera/depth/image_rect_raw/compressedDepth", kCompressed},
                            {"/camera/depth/camera_info", kInfo},
                            {"/camera/color/image_raw", kImage},
                            {"/robot/front/depth/image/compressedDepth", kCompressed},
                            {"/robot/front/depth/image/compressed", kCompressed},
                            {"/robot/rear/depth_registered/image", kImage},
                            {"/stereo/disparity", kImage}};
  const BagTopics topics = chooseTopics(available, {});
  EXPECT_EQ(name(topics, Role::Depth0), "/camera/depth/image_rect_raw");
  EXPECT_EQ(name(topics, Role::Depth0Info), "/camera/depth/camera_info");
  EXPECT_EQ(name(topics, Role::Depth1), "/robot/front/depth/image/compressedDepth");
  EXPECT_EQ(name(topics, Role::Depth2), "/robot/rear/depth_registered/image");
  EXPECT_EQ(name(topics, Role::Depth3), "none");
  EXPECT_EQ(name(topics, Role::Left), "none");
  const BagTopics aligned = chooseTopics(available, {"depth0:=/camera/aligned_depth_to_color/image_raw"});
  EXPECT_EQ(name(aligned, Role::Depth0), "/camera/aligned_depth_to_color/image_raw");
  EXPECT_EQ(name(aligned, Role::Depth0Info), "/camera/aligned_depth_to_color/camera_info");
}

TEST(BagTopics, FindsNoStereoPairInAColourAndADepthImage) {
  const BagTopics topics = chooseTopics({{"/camera/rgb", kImage}, {"/camera/depth", kImage}}, {});
  EXPECT_EQ(name(topics, Role::Left), "none");
  EXPECT_EQ(name(topics, Role::Depth0), "/camera/depth");
}

}  // namespace
}  // namespace urban_nav_input
