// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "urban_nav_input/sensors/clock_examination.hpp"
#include "urban_nav_input/sensors/gps_examination.hpp"
#include "urban_nav_input/sensors/laser_examination.hpp"
#include "urban_nav_input/sensors/reading_examination.hpp"
#include "urban_nav_input/sensors/topic_examination.hpp"

namespace urban_nav_input {
namespace {

using Options = std::vector<std::string>;
using urban_nav_core::StampNs;

constexpr StampNs kFirstStamp = 1'225'719'872'000'000'000, kTurn = 20'000'000;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

sensor_msgs::LaserScan makeScan(int i) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp.fromNSec(static_cast<std::uint64_t>(kFirstStamp + i * kTurn));
  scan.angle_min = -1.5F;
  scan.angle_increment = 0.01F;
  scan.angle_max = 1.5F;
  scan.scan_time = 0.02F;
  scan.range_min = 0.1F;
  scan.range_max = 80.0F;
  scan.ranges.assign(301, 6.0F + 0.001F * static_cast<float>(i));
  return scan;
}

template <typename Change>
std::vector<Finding> examineScans(const Change& change, int* used = nullptr) {
  LaserExamination examination("laser_left", "/laser_left/scan", {});
  for (int i = 0; i < 50; ++i) {
    sensor_msgs::LaserScan scan = makeScan(i);
    change(scan);
    if (examination.read(scan) && used != nullptr) ++*used;
  }
  return examination.findings();
}

TEST(LaserExamination, FindsNothingInASoundLaser) {
  int used = 0;
  EXPECT_TRUE(examineScans([](sensor_msgs::LaserScan&) {}, &used).empty());
  EXPECT_EQ(used, 50);
  const auto half_open = [](sensor_msgs::LaserScan& scan) {
    for (std::size_t i = 0; i < scan.ranges.size(); i += 2) scan.ranges[i] = std::numeric_limits<float>::infinity();
  };
  EXPECT_TRUE(examineScans(half_open).empty()) << "half of the beams meet the sky";
}

TEST(LaserExamination, StatesTheScaleOfOtherUnits) {
  const auto degrees = examineScans([](sensor_msgs::LaserScan& scan) {
    scan.angle_min *= 57.29578F, scan.angle_max *= 57.29578F, scan.angle_increment *= 57.29578F;
  });
  ASSERT_EQ(degrees.size(), 1U);
  EXPECT_EQ(degrees[0].kind, FindingKind::Lasers);
  EXPECT_NE(degrees[0].text.find("degrees"), std::string::npos) << degrees[0].text;
  ASSERT_EQ(degrees[0].options.size(), 2U);
  EXPECT_EQ(degrees[0].options[1].substr(0, 36), "input.laser_left_angle_scale=0.01745");
  const auto millimetres = examineScans([](sensor_msgs::LaserScan& scan) {
    for (float& range : scan.ranges) range *= 1000.0F;
    scan.range_min *= 1000.0F, scan.range_max *= 1000.0F;
  });
  ASSERT_EQ(millimetres.size(), 1U);
  EXPECT_EQ(millimetres[0].options, (Options{"--set", "input.laser_left_range_scale=0.001"}));
}

TEST(LaserExamination, NamesWhatItUsesInSpiteOfAFault) {
  int used = 0;
  const auto limit = examineScans([](sensor_msgs::LaserScan& scan) { scan.range_min = scan.range_max = 0.0F; }, &used);
  ASSERT_EQ(limit.size(), 1U);
  EXPECT_NE(limit[0].text.find("range_max"), std::string::npos);
  EXPECT_EQ(used, 50);
  const auto time = examineScans([](sensor_msgs::LaserScan& scan) { scan.scan_time = kNan; }, &used);
  ASSERT_EQ(time.size(), 1U);
  EXPECT_NE(time[0].text.find("scan_time"), std::string::npos);
  EXPECT_EQ(used, 100);
}

TEST(LaserExamination, NamesNumbersThatFollowFromOthers) {
  int used = 0;
  const std::string increment =
      examineScans([](sensor_msgs::LaserScan& scan) { scan.angle_increment = 0.0F; }, &used).at(0).text;
  EXPECT_NE(increment.find("angle_increment of 50 of 50"), std::string::npos) << increment;
  const std::string time =
      examineScans([](sensor_msgs::LaserScan& scan) { scan.time_increment = kNan; }, &used).at(0).text;
  EXPECT_NE(time.find("taken from scan_time"), std::string::npos) << time;
  EXPECT_EQ(used, 100);
}

TEST(LaserExamination, NamesTimesOfBeamsThatOverlapTheNextScan) {
  EXPECT_TRUE(examineScans([](sensor_msgs::LaserScan& scan) { scan.time_increment = 3e-5F; }).empty());
  const auto milliseconds = examineScans([](sensor_msgs::LaserScan& scan) { scan.time_increment = 0.03F; });
  ASSERT_EQ(milliseconds.size(), 1U);
  EXPECT_NE(milliseconds[0].text.find("milliseconds"), std::string::npos) << milliseconds[0].text;
  EXPECT_EQ(milliseconds[0].options, (Options{"--set", "input.laser_left_time_scale=0.001"}));
  const auto turns = examineScans([](sensor_msgs::LaserScan& scan) { scan.time_increment = 0.02F / 100.0F; });
  ASSERT_EQ(turns.size(), 1U);
  EXPECT_EQ(turns[0].options, (Options{"--set", "input.laser_left_time_scale=0"}));
}

TEST(LaserExamination, NamesWhatItCannotUse) {
  int used = 0;
  const auto angles = examineScans([](sensor_msgs::LaserScan& scan) { scan.angle_min = scan.angle_max = kNan; }, &used);
  ASSERT_EQ(angles.size(), 1U);
  EXPECT_NE(angles[0].text.find("50 of 50"), std::string::npos) << angles[0].text;
  const auto stamps = examineScans([](sensor_msgs::LaserScan& scan) { scan.header.stamp = ros::Time(); }, &used);
  ASSERT_EQ(stamps.size(), 1U);
  EXPECT_EQ(stamps[0].kind, FindingKind::Stamps);
  EXPECT_EQ(used, 0);
  const auto blind = examineScans([](sensor_msgs::LaserScan& scan) { scan.ranges.assign(301, kNan); });
  ASSERT_EQ(blind.size(), 1U);
  EXPECT_NE(blind[0].text.find("0 %"), std::string::npos) << blind[0].text;
}

/// Clocks of images and of a laser that is stamped `late` s after and received 4 ms after it was measured.
std::vector<Finding> examineClocks(double late, double drift, double jitter, double present_ms = 0.0) {
  ClockExamination clocks;
  for (int i = 0; i < 1500; ++i) {
    const StampNs now = kFirstStamp + i * kTurn;
    const auto ns = [](double seconds) { return static_cast<StampNs>(1e9 * seconds); };
    clocks.add("images", "/left", now, now + ns(0.03 + jitter * (i % 7)));
    clocks.add("laser_left", "/scan", now + ns(late + drift * i / 1500.0), now + ns(0.004));
  }
  return clocks.findings(
      [&](const std::string& role) { return role == "laser_left" ? std::optional<double>(present_ms) : std::nullopt; });
}

TEST(ClockExamination, FindsNothingInClocksThatAgree) {
  EXPECT_TRUE(examineClocks(0.0, 0.0, 0.0).empty());
  EXPECT_TRUE(examineClocks(0.2, 0.0, 0.01).empty()) << "the delay of a driver";
  EXPECT_TRUE(examineClocks(100.0, 0.0, 30.0).empty()) << "a bag that was converted: receipt has no meaning";
}

TEST(ClockExamination, StatesTheDelayOfAClockThatIsOff) {
  const std::vector<Finding> late = examineClocks(-3.0, 0.0, 0.0);
  ASSERT_EQ(late.size(), 1U);
  EXPECT_NE(late[0].text.find("earlier"), std::string::npos);
  ASSERT_EQ(late[0].options.size(), 2U);
  EXPECT_EQ(late[0].options[1].substr(0, 23), "input.laser_left_delay=");
  EXPECT_NEAR(std::stod(late[0].options[1].substr(23)), -3000.0, 50.0);
  EXPECT_NEAR(std::stod(examineClocks(-2.0, 0.0, 0.0, -1000.0)[0].options[1].substr(23)), -3000.0, 50.0);
  EXPECT_NEAR(std::stod(examineClocks(1e6, 0.0, 0.0)[0].options[1].substr(23)), 1e9, 50.0) << "a clock of 1970";
}

TEST(ClockExamination, NamesADrift) {
  const std::vector<Finding> drift = examineClocks(0.0, 0.3, 0.0);
  ASSERT_EQ(drift.size(), 1U);
  EXPECT_NE(drift[0].text.find("drifts"), std::string::npos);
  EXPECT_TRUE(drift[0].options.empty());
}

sensor_msgs::NavSatFix makeFix(int i) {
  sensor_msgs::NavSatFix fix;
  fix.header.stamp = ros::Time(100.0 + i);
  fix.latitude = 51.75 + 1e-6 * i;
  fix.longitude = -1.25;
  fix.altitude = 112.0;
  return fix;
}

template <typename Change>
std::vector<Finding> examineFixes(const Change& change) {
  GpsExamination examination;
  for (int i = 0; i < 40; ++i) {
    sensor_msgs::NavSatFix fix = makeFix(i);
    change(fix);
    examination.add(fix);
  }
  return examination.findings("/gps/fix");
}

TEST(GpsExamination, NamesEachFaultAlone) {
  EXPECT_TRUE(examineFixes([](sensor_msgs::NavSatFix&) {}).empty());
  const auto names = [](const std::vector<Finding>& found, const char* word) {
    return found.size() == 1 && found[0].kind == FindingKind::Gps && found[0].text.find(word) != std::string::npos &&
           found[0].text.find("40 of 40") != std::string::npos && !found[0].remedy.empty();
  };
  EXPECT_TRUE(names(examineFixes([](auto& fix) { fix.altitude = std::nan(""); }), "altitude"));
  EXPECT_TRUE(names(examineFixes([](auto& fix) { fix.status.status = -1; }), "status"));
  EXPECT_TRUE(names(examineFixes([](auto& fix) { fix.latitude = std::nan(""); }), "latitude"));
  EXPECT_TRUE(names(examineFixes([](auto& fix) { fix.header.stamp = ros::Time(); }), "stamp"));
  const auto zero = examineFixes([](auto& fix) { fix.latitude = fix.longitude = 0.0; });
  EXPECT_TRUE(names(zero, "latitude 0"));
  const auto frozen = examineFixes([](auto& fix) { fix.latitude = 51.75; });
  ASSERT_EQ(frozen.size(), 1U);
  EXPECT_NE(frozen[0].text.find("frozen"), std::string::npos);
}

TEST(ReadingExamination, NamesShareAndIntervalOfWhatIsNotFinite) {
  ReadingExamination examination;
  for (int i = 0; i < 200; ++i) {
    const double x = i >= 50 && i < 100 ? std::nan("") : 0.001 * i;
    examination.add(kFirstStamp + i * kTurn, {{0.0, x, 9.81, 0.0, 0.0, 0.0}});
  }
  const std::vector<Finding> found = examination.findings("/imu/data", FindingKind::Imu, true);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].text.find("25 %"), std::string::npos) << found[0].text;
  EXPECT_NE(found[0].text.find("from 1 s to 1.98 s"), std::string::npos) << found[0].text;
}

TEST(ReadingExamination, NamesADeviceThatIsFrozen) {
  ReadingExamination examination;
  for (int i = 0; i < 200; ++i)
    examination.add(kFirstStamp + i * kTurn, {{0.001 * std::min(i, 60), 0.0, 9.81, 0.0, 0.0, 0.0}});
  ASSERT_EQ(examination.findings("/imu/data", FindingKind::Imu, true).size(), 1U);
  EXPECT_TRUE(examination.findings("/wheel_odom", FindingKind::Wheels, false).empty()) << "a robot at rest";
}

TEST(TopicFindings, NameTheOptionOfEachTopicThatWouldServe) {
  std::map<std::string, std::string> available = {{"/stereo/left/image_raw", "sensor_msgs/Image"},
                                                  {"/stereo/right/image_raw", "sensor_msgs/Image"},
                                                  {"/scan", "sensor_msgs/LaserScan"},
                                                  {"/scan_rear", "sensor_msgs/LaserScan"},
                                                  {"/mti/data", "sensor_msgs/Imu"}};
  const std::vector<Finding> found = topicFindings(available, chooseTopics(available, {}));
  ASSERT_EQ(found.size(), 1U) << "scans are read as those of laser0 and laser1";
  EXPECT_EQ(found[0].options, (Options{"--topic", "imu:=/mti/data"}));
  const BagTopics named = chooseTopics(available, {"imu:=/mti/data"});
  EXPECT_TRUE(topicFindings(available, named).empty()) << "the options repair it";
}

TEST(TopicFindings, PointCloudsAreNamedWhereNoScanIs) {
  std::map<std::string, std::string> available = {{"/laser_left/points", "sensor_msgs/PointCloud2"}};
  const std::vector<Finding> found = topicFindings(available, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].remedy.find("pointcloud_to_laserscan"), std::string::npos);
  available["/laser_left/scan"] = "sensor_msgs/LaserScan";
  EXPECT_TRUE(topicFindings(available, chooseTopics(available, {})).empty());
}

}  // namespace
}  // namespace urban_nav_input
