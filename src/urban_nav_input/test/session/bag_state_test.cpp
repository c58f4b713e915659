// SPDX-License-Identifier: BSD-3-Clause
// The state between two bags survives whatever numbers their messages hold.
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/NavSatFix.h>
#include <tf2_msgs/TFMessage.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/session/source.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

using Limits = std::numeric_limits<double>;

constexpr int kOddMessages = 120;  // each sensor, in a bag at 10 Hz
constexpr double kOddStart = 1.5e9;

/// Writes messages that hold `number` in place of a measurement, between sound ones.
class OddBag {
 public:
  OddBag(const std::string& path, double number, double start)
      : bag_(path, rosbag::bagmode::Write), number_(number), start_(start) {
    tf2_msgs::TFMessage transforms;
    for (const char* child : {"camera", "imu", "laser_left", "gps"})
      transforms.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", child, urban_nav_core::Pose()));
    bag_.write("/tf_static", ros::Time(start), transforms);
    for (int i = 0; i < kOddMessages; ++i) {
      writeCameras(i);
      writeSensors(i);
    }
  }

 private:
  template <typename Message>
  void write(const std::string& topic, int i, const std::string& frame, Message message) {
    message.header.stamp = ros::Time(start_ + 0.1 * i);
    message.header.frame_id = frame;
    bag_.write(topic, message.header.stamp, message);
  }

  /// `number` in every third message, and in the last one.
  double odd(int i, double sound) const { return i % 3 == 0 || i == kOddMessages - 1 ? number_ : sound; }

  void writeCameras(int i) {
    for (const std::string side : {"left", "right"}) {
      sensor_msgs::Image image;
      image.encoding = "mono8";
      image.width = image.step = 32;
      image.height = 24;
      image.data.assign(image.step * image.height, static_cast<std::uint8_t>(i));
      write("/stereo/" + side + "/image_raw", i, "camera", image);
      sensor_msgs::CameraInfo info;
      info.width = 32;
      info.height = 24;
      info.P = {30, 0, 15.5, side == "left" ? 0.0 : -6.0, 0, 30, 11.5, 0, 0, 0, 1, 0};
      write("/stereo/" + side + "/camera_info", i, "camera", info);
    }
  }

  void writeSensors(int i) {
    sensor_msgs::Imu imu;
    imu.angular_velocity.z = odd(i, 0.01 * i);
    imu.angular_velocity.x = odd(i + 1, 0.0);
    imu.linear_acceleration.x = odd(i + 2, 0.1);
    imu.linear_acceleration.z = odd(i, 9.81);
    write("/imu/data", i, "imu", imu);
    nav_msgs::Odometry wheels;
    wheels.pose.pose.position.x = odd(i, 0.1 * i);
    wheels.pose.pose.position.y = odd(i + 1, 0.0);
    wheels.pose.pose.orientation.w = odd(i + 2, 1.0);
    wheels.twist.twist.linear.x = odd(i, 1.0);
    write("/wheel_odom", i, "odom", wheels);
    sensor_msgs::NavSatFix fix;
    fix.latitude = odd(i, 51.75);
    fix.longitude = odd(i + 1, -1.25);
    fix.altitude = odd(i + 2, 112.0);
    fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_KNOWN;
    fix.position_covariance[0] = fix.position_covariance[4] = odd(i, 4.0);
    write("/gps/fix", i, "gps", fix);
    sensor_msgs::LaserScan scan;
    const auto number = static_cast<float>(odd(i, 0.05));
    scan.angle_min = i % 2 == 0 ? -1.5F : number;
    scan.angle_increment = i % 5 == 0 ? number : 0.05F;
    scan.angle_max = i % 7 == 0 ? number : 1.5F;
    scan.time_increment = i % 11 == 0 ? number : 0.0005F;
    scan.scan_time = scan.range_min = number;
    scan.range_max = static_cast<float>(odd(i + 1, 80.0));
    scan.ranges.assign(61, static_cast<float>(odd(i + 2, 6.0 + 0.01 * i)));
    write("/laser_left/scan", i, "laser_left", scan);
  }

  rosbag::Bag bag_;
  double number_, start_;
};

std::string readFindings(const std::vector<std::string>& paths, const BagEnd* after,
                         std::shared_ptr<const BagEnd>* end) {
  const std::unique_ptr<Source> source = openSource(paths, SourceOptions(), after);
  while (const std::optional<SourceItem> item = source->next())
    if (item->bag_end && end != nullptr && !*end) *end = item->bag_end;
  std::string text;
  for (const Finding& finding : source->sensorFindings()) text += finding.text + "\n";
  return text;
}

TEST(BagState, HoldsWhateverNumbersTheMessagesHold) {
  for (const double number : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::max(),
                              -Limits::max(), 1e200, Limits::denorm_min(), 0.0}) {
    const testing::TemporaryFolder folder;
    const std::vector<std::string> both = {folder.file("a.bag"), folder.file("b.bag")};
    OddBag(both[0], number, kOddStart);
    OddBag(both[1], number, kOddStart + 0.1 * kOddMessages);
    std::shared_ptr<const BagEnd> end;
    const std::string whole = readFindings(both, nullptr, &end);
    ASSERT_TRUE(end) << number;
    EXPECT_EQ(readFindings(both, end.get(), nullptr), whole) << number;
    EXPECT_EQ(whole.find("inf "), std::string::npos) << whole;
  }
}

}  // namespace
}  // namespace urban_nav_input
