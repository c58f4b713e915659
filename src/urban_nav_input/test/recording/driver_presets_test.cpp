// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/driver_presets.hpp"

#include <gtest/gtest.h>

#include "recording/role_names.hpp"
#include "session/given_transforms.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"

namespace urban_nav_input {
namespace {

using Recorded = std::map<std::string, std::string>;
const char* const kImages = "sensor_msgs/Image";
const char* const kInfos = "sensor_msgs/CameraInfo";
const char* const kImu = "sensor_msgs/Imu";
const char* const kCloud = "sensor_msgs/PointCloud2";

const Recorded kRealSense = {{"/camera/camera/infra1/image_rect_raw", kImages},
                             {"/camera/camera/infra2/image_rect_raw", kImages},
                             {"/camera/camera/infra1/camera_info", kInfos},
                             {"/camera/camera/infra2/camera_info", kInfos},
                             {"/camera/camera/color/image_raw", kImages},
                             {"/camera/camera/imu", kImu},
                             {"/mti/imu", kImu}};

std::string chosenName(const BagTopics& topics, Role role) {
  return topics.find(role) ? topics.find(role)->name : "none";
}

std::string presetRefusal(const Recorded& recorded, const std::vector<std::string>& wishes) {
  try {
    chooseTopics(recorded, wishes);
  } catch (const urban_nav_core::UserError& error) {
    return error.what();
  }
  return "accepted";
}

bool isNoted(const BagTopics& topics, const std::string& text) {
  for (const std::string& note : topics.notes)
    if (note.find(text) != std::string::npos) return true;
  return false;
}

TEST(DriverPresets, NameRolesThatExistAndTransformsThatCanBeRead) {
  for (const DriverPreset& preset : driverPresets()) {
    for (const PresetRole& role : preset.roles) {
      EXPECT_TRUE(roleFromWord(role.role) || std::string(role.role) == "points") << preset.name << " " << role.role;
      EXPECT_FALSE(role.names.empty()) << preset.name;
    }
    urban_nav_ros::StaticTransforms transforms;
    EXPECT_NO_THROW(giveTransforms(presetTransforms(preset), transforms)) << preset.name;
  }
}

TEST(DriverPresets, GiveTheTopicsOfAnyNamespace) {
  const BagTopics topics = chooseTopics(kRealSense, {"preset:=realsense"});
  EXPECT_EQ(chosenName(topics, Role::Left), "/camera/camera/infra1/image_rect_raw");
  EXPECT_EQ(chosenName(topics, Role::RightInfo), "/camera/camera/infra2/camera_info");
  EXPECT_EQ(chosenName(topics, Role::Imu), "/camera/camera/imu");
  EXPECT_TRUE(isNoted(topics, "left: /camera/camera/infra1/image_rect_raw (preset realsense)"));
  EXPECT_TRUE(isNoted(topics, "preset realsense: realsense2_camera"));
}

TEST(DriverPresets, GivenTopicsTakePrecedence) {
  const BagTopics topics = chooseTopics(kRealSense, {"preset:=realsense", "imu:=/mti/imu"});
  EXPECT_EQ(chosenName(topics, Role::Imu), "/mti/imu");
  EXPECT_EQ(chosenName(topics, Role::Left), "/camera/camera/infra1/image_rect_raw");
}

TEST(DriverPresets, NameAllRolesThatTheRecordingLacks) {
  Recorded without = kRealSense;
  without.erase("/camera/camera/infra2/image_rect_raw");
  without.erase("/camera/camera/infra1/camera_info");
  without["/camera/camera/infra1/camera_info"] = kCloud;  // of another type
  const std::string refusal = presetRefusal(without, {"preset:=realsense"});
  EXPECT_NE(refusal.find("--preset realsense"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("right (.../infra2/image_rect_raw)"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("left_info (.../infra1/camera_info)"), std::string::npos) << refusal;
  EXPECT_EQ(refusal.find("right_info"), std::string::npos) << refusal;
  without["/mine/camera_info"] = kInfos;
  EXPECT_EQ(presetRefusal(without, {"preset:=realsense", "right:=/camera/camera/color/image_raw",
                                    "left_info:=/mine/camera_info"}),
            "accepted");
}

TEST(DriverPresets, NoteOptionalRolesThatTheRecordingLacks) {
  const BagTopics topics = chooseTopics({{"/velodyne_points", kCloud}, {"/os_cloud_node/points", kCloud}},
                                        {"preset:=ouster", "preset:=velodyne"});
  EXPECT_TRUE(isNoted(topics, "preset ouster: no topic for imu"));
  EXPECT_EQ(chosenName(topics, Role::Points0), "/os_cloud_node/points") << "in the order of the presets";
  EXPECT_EQ(chosenName(topics, Role::Points1), "/velodyne_points");
}

TEST(DriverPresets, AllCloudsOfADriverAreLidars) {
  const BagTopics topics = chooseTopics({{"/livox/lidar_192_168_1_10", "livox_ros_driver2/CustomMsg"},
                                         {"/livox/lidar_192_168_1_11", "livox_ros_driver2/CustomMsg"},
                                         {"/livox/imu_192_168_1_10", kImu},
                                         {"/livox/lidar/filtered", kCloud}},
                                        {"preset:=livox"});
  EXPECT_EQ(chosenName(topics, Role::Points0), "/livox/lidar_192_168_1_10");
  EXPECT_EQ(chosenName(topics, Role::Points1), "/livox/lidar_192_168_1_11");
  EXPECT_EQ(chosenName(topics, Role::Points2), "none");
  EXPECT_EQ(chosenName(topics, Role::Imu), "/livox/imu_192_168_1_10");
  EXPECT_TRUE(isNoted(topics, "input.accelerometer_scale is 9.80665 unless it is set"));
}

TEST(DriverPresets, OfScannersNeedAScanOrACloud) {
  const Recorded scans = {{"/sick_tim_7xx/scan", "sensor_msgs/LaserScan"}};
  EXPECT_EQ(chosenName(chooseTopics(scans, {"preset:=sick"}), Role::LaserLeft), "/sick_tim_7xx/scan");
  EXPECT_EQ(chosenName(chooseTopics({{"/cloud", kCloud}}, {"preset:=sick"}), Role::Points0), "/cloud");
  const std::string refusal = presetRefusal({{"/velodyne_points", kCloud}}, {"preset:=sick"});
  EXPECT_NE(refusal.find("laser_left (.../scan"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find(" or points ("), std::string::npos) << refusal;
}

TEST(DriverPresets, TakeTheFirstImagesOfAZedThatWereRecorded) {
  const Recorded zed = {{"/zed2/zed_node/left/image_rect_color/compressed", "sensor_msgs/CompressedImage"},
                        {"/zed2/zed_node/right/image_rect_color/compressed", "sensor_msgs/CompressedImage"},
                        {"/zed2/zed_node/left_raw/image_raw_color", kImages},
                        {"/zed2/zed_node/left/camera_info", kInfos},
                        {"/zed2/zed_node/right/camera_info", kInfos}};
  const BagTopics topics = chooseTopics(zed, {"preset:=zed"});
  EXPECT_EQ(chosenName(topics, Role::Left), "/zed2/zed_node/left/image_rect_color/compressed");
  EXPECT_EQ(chosenName(topics, Role::Right), "/zed2/zed_node/right/image_rect_color/compressed");
  EXPECT_EQ(chosenName(topics, Role::LeftInfo), "/zed2/zed_node/left/camera_info");
}

TEST(DriverPresets, OfAnotherNameAreRefusedWithTheKnownOnes) {
  const std::string refusal = presetRefusal(kRealSense, {"preset:=kinect"});
  EXPECT_NE(refusal.find("kinect"), std::string::npos);
  EXPECT_NE(refusal.find("livox, ouster, realsense, sick, ublox, velodyne, zed"), std::string::npos) << refusal;
}

TEST(DriverPresets, NamesMatchWholePartsOfTopics) {
  EXPECT_TRUE(hasPresetName("/velodyne_points", "velodyne_points"));
  EXPECT_TRUE(hasPresetName("velodyne_points", "velodyne_points"));
  EXPECT_FALSE(hasPresetName("/front_velodyne_points", "velodyne_points"));
  EXPECT_FALSE(hasPresetName("/velodyne_points/filtered", "velodyne_points"));
  EXPECT_TRUE(hasPresetName("/a/livox/lidar_1", "livox/lidar*"));
  EXPECT_TRUE(hasPresetName("/livox/lidar", "livox/lidar*"));
  EXPECT_FALSE(hasPresetName("/livox/lid", "livox/lidar*"));
  EXPECT_FALSE(hasPresetName("/xlivox/lidar", "livox/lidar*"));
  EXPECT_TRUE(hasPresetName("/c/infra1/image_rect_raw/compressed", "infra1/image_rect_raw"));
}

TEST(DriverPresets, TransformsAreUsedWhereTheRecordingHasNone) {
  const std::vector<std::string> given = presetTransforms(findDriverPreset("ouster"));
  urban_nav_ros::StaticTransforms none;
  EXPECT_EQ(giveTransforms(given, none).size(), 3U);
  const auto T_base_imu = none.lookup("base_link", "os_imu");
  ASSERT_TRUE(T_base_imu);
  EXPECT_NEAR(T_base_imu->t().x(), 0.006253, 1e-12);
  urban_nav_ros::StaticTransforms mounted;
  mounted.add(urban_nav_ros::toStaticTransform(
      "base_link", "os_sensor", urban_nav_core::Pose(urban_nav_core::Matrix3d::Identity(), {1.0, 0.0, 2.0})));
  EXPECT_EQ(giveTransforms(given, mounted).size(), 2U) << "not that of base_link";
  EXPECT_NEAR(mounted.lookup("base_link", "os_lidar")->t().z(), 2.03618, 1e-12);
}

}  // namespace
}  // namespace urban_nav_input
