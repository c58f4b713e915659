// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/new_college_log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::UserError;
using urban_nav_core::Vector3d;

const char* const kStart = "%% LOGSTART 1225719811.65\n";
const char* const kScan =
    "61.850 LMS_LASER_2D_LEFT LMS1 ID=4044,time=1225719873.501685,angRes=0.50,offset=0.00,minAngle=45.00,"
    "maxAngle=46.00,scanCount=41,Range=[3]{1.054,-1.000,1.059},Reflectance=[3]{40.000,0.000,44.000} \n";
const char* const kRaw =
    "61.855 RAW_ODOMETRY_POSE iPlatform Pose=[3x1]{4.2,18.5,-0.7993},Vel=[3x1]{-0.7,-0.7,-6.2},Raw=[2x1]{19.9,-0.7},"
    "time=1225719873.50240921974182,Speed=1.10247948365994,Pitch=0.02,Roll=0.03,PitchDot=0.5,RollDot=0.001 \n";
const char* const kOdometry =
    "61.855 ODOMETRY_POSE iPlatform Pose=[3x1]{4.2216,18.5450,-0.7990},Vel=[3x1]{-0.7,-0.7,0.0011},"
    "Raw=[2x1]{19.9,-0.7},time=1225719873.5024,Speed=1.1025,Pitch=-0.0241,Roll=0.0235,PitchDot=0.0359,RollDot=0.0013 "
    "\n";
const char* const kPanorama =
    "61.244 CAMERA_FILE_WRITE iCameraLadybug time=1225719872.892,Pan=0.00,NumImages=2,"
    "File0=/home/x/Images/ladybug_1225719872.892-0.jpg,"
    "File1=/home/x/Images/ladybug_1225719872.892-1.jpg \n";

class NewCollege : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }
  std::vector<NewCollegeEvent> events(const std::string& text) {
    urban_nav_core::writeAtomically(path_, text);
    NewCollegeLog log(path_);
    std::vector<NewCollegeEvent> all;
    while (auto event = log.next()) all.push_back(*event);
    counts_ = log.counts();
    return all;
  }
  std::string error(const std::string& text) {
    try {
      events(text);
    } catch (const UserError& e) {
      return std::string(e.what()).substr(path_.size());
    }
    return "";
  }
  const std::string path_ =
      (std::filesystem::temp_directory_path() / ("new_college_" + std::to_string(::getpid()) + ".alog")).string();
  NewCollegeCounts counts_;
};

TEST_F(NewCollege, EventsComeInOrderOfTheirStamps) {
  const auto all = events(std::string(kStart) + kScan + kRaw + kOdometry + kPanorama);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<NewCollegePanorama>(all[0]));
  EXPECT_TRUE(std::holds_alternative<NewCollegeScan>(all[1]));
  EXPECT_TRUE(std::holds_alternative<NewCollegeOdometry>(all[2]));
  EXPECT_EQ(std::get<NewCollegePanorama>(all[0]).files[1], "ladybug_1225719872.892-1.jpg");
}

TEST_F(NewCollege, ScansHaveTheirAnglesAndNoErrorCodes) {
  const auto scan = std::get<NewCollegeScan>(events(std::string(kStart) + kScan).at(0));
  EXPECT_EQ(scan.stamp, 1225719873501685000);
  EXPECT_EQ(scan.id, 4044);
  EXPECT_EQ(scan.scan.ranges, (std::vector<float>{1.054F, 0.0F, 1.059F}));
  EXPECT_EQ(scan.scan.intensities, (std::vector<float>{40.0F, 0.0F, 44.0F}));
  EXPECT_NEAR(scan.scan.angle_first, -M_PI / 4, 1e-15);
  EXPECT_NEAR(scan.scan.angle_step, M_PI / 360, 1e-15);
  EXPECT_NEAR(scan.scan.time_step, 18.5e-6, 0.1e-6);
  EXPECT_EQ(urban_nav_core::toScan(scan.scan).beams.size(), 2U);
}

TEST_F(NewCollege, OdometryIsInRep103WithTheTiltOfTheRawRow) {
  for (const std::string& text : {std::string(kStart) + kRaw + kOdometry, std::string(kStart) + kOdometry + kRaw}) {
    const auto odometry = std::get<NewCollegeOdometry>(events(text).at(0));
    EXPECT_EQ(odometry.stamp, 1225719873502400000);
    EXPECT_EQ(odometry.T_odom_base.t(), Vector3d(4.2216, 18.545, 0.0));
    EXPECT_EQ(odometry.speed, 1.1025);
    EXPECT_EQ(odometry.pitch_rate, -0.5);
    const Vector3d forward = odometry.T_odom_base.q() * Vector3d::UnitX();
    EXPECT_NEAR(forward.x() / forward.y(), -std::sin(-0.799) / std::cos(-0.799), 1e-12);
    EXPECT_NEAR(forward.z(), std::sin(0.02), 1e-12)
        << "RAW's positive pitch, about the axis to the right, lifts the front";
    EXPECT_NEAR((odometry.T_odom_base.q() * Vector3d::UnitY()).z(), std::cos(0.02) * std::sin(0.03), 1e-12)
        << "left side up";
    EXPECT_EQ(counts_.odometry_without_tilt, 0);
  }
  const auto bare = std::get<NewCollegeOdometry>(events(std::string(kStart) + kOdometry).at(0));
  EXPECT_EQ((bare.T_odom_base.q() * Vector3d::UnitX()).z(), 0.0);
  EXPECT_EQ(counts_.odometry_without_tilt, 1);
}

TEST_F(NewCollege, TurningRateComesFromNeighbouringHeadings) {
  std::string text = kStart;
  for (int i = 0; i < 5; ++i) {
    const std::string stamp = "1225719873.5" + std::to_string(i) + "00";
    text += "61.9 ODOMETRY_POSE i Pose=[3x1]{0,0," + std::to_string(3.13 + 0.01 * i) + "},time=" + stamp + ",Speed=1\n";
  }
  for (const auto& event : events(text)) EXPECT_NEAR(std::get<NewCollegeOdometry>(event).yaw_rate, 1.0, 1e-6);
}

TEST_F(NewCollege, LostScansAndTooLateRowsAreCounted) {
  const auto scan = [](int id, const std::string& stamp) {
    return "61.8 LMS_LASER_2D_LEFT LMS1 ID=" + std::to_string(id) + ",time=" + stamp +
           ",angRes=0.50,minAngle=45.00,maxAngle=45.00,Range=[1]{1.0},Reflectance=[1]{40}\n";
  };
  const auto all = events(kStart + scan(7, "1225719873.5") + scan(9, "1225719873.6") + scan(300, "1225719880.0") +
                          scan(8, "1225719873.55"));
  EXPECT_EQ(all.size(), 4U - 1U);
  EXPECT_EQ(counts_.scans_lost, 1 + 290);
  EXPECT_EQ(counts_.out_of_order, 1);
  EXPECT_TRUE(counts_.unused.empty());
}

TEST_F(NewCollege, RowsOfOtherVariablesAreCounted) {
  const std::string other = "61.8 GPS_STATUS iGPS Fix=1\n";
  EXPECT_EQ(events(std::string(kStart) + other + kScan + other).size(), 1U);
  EXPECT_EQ(counts_.unused, (std::map<std::string, std::int64_t>{{"GPS_STATUS", 2}}));
}

TEST_F(NewCollege, DamageIsNamedWithItsLine) {
  const std::string whole = std::string(kStart) + kScan;
  EXPECT_NE(error(whole.substr(0, whole.size() - 20)).find(":2: Reflectance: incomplete array"), std::string::npos);
  EXPECT_NE(error(whole.substr(0, whole.find(",Range"))).find(":2: no field `Range`"), std::string::npos);
  std::string text = whole;
  text.replace(text.find("maxAngle=46.00"), 14, "maxAngle=47.00");
  EXPECT_NE(error(text).find(":2: 3 ranges"), std::string::npos);
  text = whole;
  text.replace(text.find("time=1225719873"), 15, "time=1335719873");
  EXPECT_NE(error(text).find(":2: time = 1335719873.501685"), std::string::npos);
}

TEST_F(NewCollege, TheRealCut) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  const std::string packed = std::string(data == nullptr ? "" : data) + "/new_college/QuadTree_Alog.alog.xz";
  if (data == nullptr || !std::filesystem::exists(packed))
    GTEST_SKIP() << "URBAN_NAV_DATA names no folder with new_college/QuadTree_Alog.alog.xz";
  if (std::system(("xz -dc '" + packed + "' > '" + path_ + "'").c_str()) != 0) GTEST_SKIP() << "xz is not installed";
  NewCollegeLog log(path_);
  urban_nav_core::StampNs last = 0;
  int invalid = 0;
  double way = 0.0;
  std::optional<Pose> before;
  while (const auto event = log.next()) {
    EXPECT_LE(last, toStamp(*event));
    last = toStamp(*event);
    if (const auto* scan = std::get_if<NewCollegeScan>(&*event)) {
      ASSERT_EQ(scan->scan.ranges.size(), 181U);
      ASSERT_EQ(scan->scan.intensities.size(), 181U);
      for (const float range : scan->scan.ranges) invalid += range <= 0.0F ? 1 : 0;
    }
    if (const auto* odometry = std::get_if<NewCollegeOdometry>(&*event)) {
      if (before) {
        const Vector3d step = before->inverse() * odometry->T_odom_base.t();
        way += step.norm();
        EXPECT_LT(std::abs(step.y()), 0.01) << "wheels do not slide sideways";
        EXPECT_GT(step.x(), 0.0);
      }
      EXPECT_LT(std::abs(odometry->yaw_rate), 0.5);
      before = odometry->T_odom_base;
    }
  }
  EXPECT_EQ(log.counts().scans_left, 263);
  EXPECT_EQ(log.counts().scans_right, 255);
  EXPECT_EQ(log.counts().scans_lost, 0);
  EXPECT_EQ(log.counts().odometry, 98);
  EXPECT_EQ(log.counts().odometry_without_tilt, 0);
  EXPECT_EQ(log.counts().panoramas, 10);
  EXPECT_EQ(log.counts().out_of_order, 0);
  EXPECT_EQ(invalid, 11893 + 11193);
  EXPECT_NEAR(way, 3.711, 0.002);
}

TEST_F(NewCollege, Fuzzed) {
  const auto result = urban_nav_core::testing::fuzzFile(
      {std::string(kStart) + kScan + kRaw + kOdometry + kPanorama}, "log.alog", [](const std::string& path) {
        NewCollegeLog log(path);
        while (const auto event = log.next()) {
          if (const auto* odometry = std::get_if<NewCollegeOdometry>(&*event)) {
            if (!odometry->T_odom_base.isFinite() || !std::isfinite(odometry->yaw_rate))
              throw std::runtime_error("not finite");
          }
        }
      });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

}  // namespace
}  // namespace urban_nav_input
