// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/LaserScan.h>

#include <cstdlib>
#include <filesystem>

#include "convert/convert.hpp"
#include "convert/row_check.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/folder/new_college_files.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

namespace fs = std::filesystem;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_input::testing::writeFile;

TEST(NewCollegeFiles, FindsPartsByTheirNames) {
  const TemporaryFolder folder;
  writeFile(folder.file("a/MOOSLog.alog"), "");
  writeFile(folder.file("a/Images/ladybug_1225719872.892-0.jpg"), "");
  writeFile(folder.file("a/Images/ladybug_1225719872.892-4.jpg"), "");
  writeFile(folder.file("a/Images/ladybug_1225719872.892-7.jpg"), "");
  writeFile(folder.file("a/StereoImages/StereoImage__1225719884.662058-left.pnm"), "");
  writeFile(folder.file("a/StereoImages/StereoImage__1225719884.662058-right.pnm"), "");
  writeFile(folder.file("a/StereoImages/StereoImage__rectified__1225719884.712048-left.pgm"), "");
  const urban_nav_input::NewCollegeFiles files = urban_nav_input::findNewCollege(folder.file("a"));
  EXPECT_EQ(files.panorama.size(), 2U) << "a Ladybug has five cameras";
  EXPECT_EQ(files.panorama[1].camera, 4);
  EXPECT_EQ(files.panorama[0].stamp, 1225719872892000000);
  ASSERT_EQ(files.stereo.size(), 2U);
  EXPECT_EQ(files.stereo[0].stamp, 1225719884662058000);
  EXPECT_FALSE(files.stereo[0].right.empty());
  EXPECT_TRUE(files.stereo[1].right.empty());
  EXPECT_THROW(urban_nav_input::findNewCollege(folder.file("nowhere")), urban_nav_core::UserError);
  fs::create_directories(folder.file("empty"));
  EXPECT_THROW(urban_nav_input::findNewCollege(folder.file("empty")), urban_nav_core::UserError);
}

TEST(NewCollegeBag, HoldsTheRealCut) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  if (data == nullptr) GTEST_SKIP() << "URBAN_NAV_DATA is not set: the log of New College is not here";
  const TemporaryFolder folder;
  const std::string command =
      "xz -dc '" + std::string(data) + "/new_college/QuadTree_Alog.alog.xz' > '" + folder.file("cut.alog") + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  Console console;
  const Converted converted = convertNewCollege(folder.file("cut.alog"), folder.file("cut.bag"), console);
  EXPECT_EQ(converted.counts.at("/laser_left/scan"), 263);
  EXPECT_EQ(converted.counts.at("/laser_right/scan"), 255);
  EXPECT_EQ(converted.counts.at("/wheel_odom"), 98);
  rosbag::Bag bag(folder.file("cut.bag"));
  rosbag::View view(bag);
  ros::Time last;
  double roll_span = 0.0;
  for (const rosbag::MessageInstance& instance : view) {
    EXPECT_GE(instance.getTime(), last);
    last = instance.getTime();
    if (const auto scan = instance.instantiate<sensor_msgs::LaserScan>()) {
      EXPECT_EQ(scan->ranges.size(), 181U);
      EXPECT_EQ(scan->intensities.size(), 181U);
      EXPECT_NEAR(scan->angle_min, -M_PI / 4, 1e-6);
      EXPECT_NEAR(scan->time_increment, 18.5e-6, 1e-6);
    }
    if (const auto odometry = instance.instantiate<nav_msgs::Odometry>())
      roll_span = std::max(roll_span,
                           std::abs(odometry->pose.pose.orientation.x) + std::abs(odometry->pose.pose.orientation.y));
  }
  EXPECT_GT(roll_span, 0.001) << "the tilt is there";
}

TEST(NewCollegeBag, LeavesNothingWhereTheLogIsDamaged) {
  const TemporaryFolder folder;
  writeFile(folder.file("in/cut.alog"),
            "%% LOGSTART               1225719811.65\n61.850 LMS_LASER_2D_LEFT LMS1 "
            "ID=4044,time=1225719873.501685,angRes=0.50,Range=[181]{1.054,\n");
  Console console;
  try {
    convertNewCollege(folder.file("in"), folder.file("cut.bag"), console);
    FAIL() << "a damaged row must end a conversion";
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find("cut.alog:2"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(folder.file("cut.bag")));
}

TEST(NewCollegeBag, MakesNoBagOfAnEmptyLog) {
  const TemporaryFolder folder;
  writeFile(folder.file("cut.alog"), "%% LOGSTART               1225719811.65\n");
  Console console;
  EXPECT_THROW(convertNewCollege(folder.file("cut.alog"), folder.file("cut.bag"), console), urban_nav_core::DataError);
  EXPECT_FALSE(fs::exists(folder.file("cut.bag")));
}

}  // namespace
}  // namespace urban_nav
