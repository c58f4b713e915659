// SPDX-License-Identifier: BSD-3-Clause
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "segway_drivers/lms291/telegram.hpp"
#include "segway_drivers/segway_rmp/can_frame.hpp"
#include "segway_drivers/transport/port.hpp"
#include "terminal.hpp"
#include "urban_nav_ros/testing/receipts.hpp"

namespace segway_drivers::test {
namespace {

constexpr double kMirrorPeriod = 0.0133381;  // s
constexpr double kPatience = 300.0;          // s, for what takes a few on an idle machine

Bytes makeTelegram(int number) {
  Bytes payload = {0xC4};
  appendLittle(payload, 0x4000U | 181U);
  for (int beam = 0; beam < 181; ++beam) appendLittle(payload, static_cast<std::uint16_t>(1000 + beam));
  appendLittle(payload, 181);
  appendLittle(payload, 1);
  appendLittle(payload, 181);
  payload.insert(payload.end(), 181, 77);
  payload.push_back(static_cast<std::uint8_t>(number & 0xFF));
  payload.push_back(0x10);
  Bytes telegram = {0x02, 0x80};
  appendLittle(telegram, static_cast<std::uint16_t>(payload.size()));
  telegram.insert(telegram.end(), payload.begin(), payload.end());
  appendLittle(telegram, computeLmsCrc(telegram));
  return telegram;
}

/// Returns the port of a driver, which its test simulates.
std::string readPort(const std::string& node) {
  std::string port;
  EXPECT_TRUE(ros::param::get(node + "/port", port)) << node;
  return port;
}

/// Calls `step` every 2 ms for so long, or until it returns true.
bool runFor(double seconds, const std::function<bool(double t)>& step) {
  const TimeNs begin = steadyTime();
  while (ros::ok()) {
    const double t = 1e-9 * static_cast<double>(steadyTime() - begin);
    if (step(t)) return true;
    if (t > seconds) return false;
    ros::spinOnce();
    ros::WallDuration(0.002).sleep();
  }
  return false;
}

std::map<std::string, std::string> levels_by_name;

void takeDiagnostics(const diagnostic_msgs::DiagnosticArray& array) {
  for (const auto& status : array.status) levels_by_name[status.name] = status.message;
}

bool anyDiagnostics(const std::string& part, const std::string& message) {
  for (const auto& [name, text] : levels_by_name)
    if (name.find(part) != std::string::npos && text == message) return true;
  return false;
}

TEST(DriverNodelets, ALaserIsPublishedAndItsUnplugIsReported) {
  ros::NodeHandle nh;
  std::vector<sensor_msgs::LaserScan> scans;
  const ros::Subscriber subscriber = nh.subscribe<sensor_msgs::LaserScan>(
      "laser_left/scan", 1000, [&](const sensor_msgs::LaserScanConstPtr& scan) { scans.push_back(*scan); });
  const ros::Subscriber diagnostics = nh.subscribe("/diagnostics", 100, takeDiagnostics);
  int number = 0;
  double due = 0.0;
  {
    Terminal terminal(readPort("/laser_left/laser"));
    const auto stream = [&](double t) {
      for (; due <= t; due += kMirrorPeriod) terminal.write(makeTelegram(number++));
      return scans.size() > 200 && anyDiagnostics("laser", "streaming");
    };
    ASSERT_TRUE(runFor(kPatience, stream)) << scans.size();
  }
  ros::Time last;
  for (const auto& scan : scans) {
    ASSERT_EQ(scan.ranges.size(), 181U);
    EXPECT_FLOAT_EQ(scan.ranges[180], 1.18F);
    EXPECT_EQ(scan.intensities[0], 77.0F);
    EXPECT_GT(scan.header.stamp, last);
    last = scan.header.stamp;
    EXPECT_EQ(scan.header.frame_id, "laser_left");
  }
  EXPECT_TRUE(runFor(kPatience, [](double) { return anyDiagnostics("laser", "lost"); }));
}

TEST(DriverNodelets, TheBaseStopsHalfASecondAfterTheLastCommand) {
  ros::NodeHandle nh;
  Terminal terminal(readPort("/base"));
  const urban_nav_ros::testing::Receipts receipts("base");
  ros::Publisher command = nh.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  int odometry = 0, cycle = 0, moving = 0;
  const ros::Subscriber subscriber =
      nh.subscribe<nav_msgs::Odometry>("wheel_odom", 100, [&](const nav_msgs::OdometryConstPtr&) { ++odometry; });
  Bytes pending;
  double due = 0.0, velocity = 0.0;
  const auto step = [&](double t) -> void {
    for (; due <= t; due += 0.01, ++cycle) {
      for (std::uint16_t id = 0x400; id < 0x408; ++id) {
        Bytes packet = {
            0xF0, 0x55, 0xAA, 0, static_cast<std::uint8_t>(id >> 3), static_cast<std::uint8_t>((id & 7) << 5), 0, 0, 0};
        packet.insert(packet.end(), 6, 0);
        appendBig(packet, static_cast<std::uint16_t>(id == 0x402 ? cycle : 0));
        unsigned sum = 0;
        for (const std::uint8_t byte : packet) sum += byte;
        sum = (sum & 0xFFU) + (sum >> 8);
        packet.push_back(static_cast<std::uint8_t>(0x100U - ((sum & 0xFFU) + (sum >> 8))));
        terminal.write(packet);
      }
    }
    const Bytes bytes = terminal.read();
    pending.insert(pending.end(), bytes.begin(), bytes.end());
    while (pending.size() >= kRmpPacketSize) {
      if (pending[0] == 0xF0 && pending[1] == 0x55) {
        velocity = static_cast<std::int16_t>(bigWord(pending.data() + 9)) / 332.0;
        moving += velocity != 0.0 ? 1 : 0;
        pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(kRmpPacketSize));
      } else {
        pending.erase(pending.begin());
      }
    }
  };
  geometry_msgs::Twist twist;
  twist.linear.x = 0.4;
  const auto drive = [&](double t) {
    step(t);
    command.publish(twist);
    return velocity > 0.39 && odometry > 50;
  };
  ASSERT_TRUE(runFor(kPatience, drive)) << velocity << " " << odometry;
  // Twice, since one that was sent before may have come in place of the last.
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(receipts.await({{"cmd_vel", 1}}, [&] { command.publish(twist); }));
  step(due);
  due = 0.0;
  moving = 0;
  EXPECT_TRUE(runFor(kPatience, [&](double t) {
    step(t);
    return velocity == 0.0;
  }));
  EXPECT_LT(moving, 35) << "of 50 commands a second: 0.7 s, however late this machine reads them";
}

}  // namespace
}  // namespace segway_drivers::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "segway_drivers_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
