// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>

#include <sstream>

#include "urban_nav_input/session/input_parameters.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

sensor_msgs::LaserScan scanAt(const ros::Time& stamp, const std::string& frame) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = stamp;
  scan.header.frame_id = frame;
  scan.angle_min = -1.5F;
  scan.angle_increment = 0.3F;
  scan.range_max = 80.0F;
  scan.ranges.assign(10, 4.0F);
  return scan;
}

/// A bag whose right images are stamped 8 ms late, with wheels, an IMU and two lasers.
void writeMovingBag(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "imu_link", urban_nav_core::Pose()));
  for (const char* laser : {"laser_left", "laser_right"})
    transforms.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", laser, urban_nav_core::Pose()));
  bag.write("/tf_static", ros::Time(1.5e9), transforms);
  for (int i = 0; i < 12; ++i) {
    const ros::Time stamp(1.5e9 + 0.05 * i);
    for (const bool is_right : {false, true}) {
      const std::string topic = is_right ? "/stereo/right" : "/stereo/left";
      sensor_msgs::Image image;
      image.header.stamp = is_right ? stamp + ros::Duration(0.008) : stamp;
      image.encoding = "mono8";
      image.width = image.step = 32;
      image.height = 24;
      image.data.assign(image.step * image.height, 100);
      sensor_msgs::CameraInfo info;
      info.header.stamp = image.header.stamp;
      info.width = image.width;
      info.height = image.height;
      info.P = {30.0, 0.0, 15.5, is_right ? -6.0 : 0.0, 0.0, 30.0, 11.5, 0.0, 0.0, 0.0, 1.0, 0.0};
      bag.write(topic + "/image_raw", image.header.stamp, image);
      bag.write(topic + "/camera_info", image.header.stamp, info);
    }
    sensor_msgs::Imu imu;
    imu.header.stamp = stamp;
    imu.header.frame_id = "imu_link";
    imu.angular_velocity.z = 0.1;
    imu.linear_acceleration.y = 0.1;
    imu.linear_acceleration.z = 9.8;
    bag.write("/imu/data", stamp, imu);
    for (const std::string laser : {"laser_left", "laser_right"})
      bag.write("/" + laser + "/scan", stamp, scanAt(stamp, laser));
    nav_msgs::Odometry wheels;
    wheels.header.stamp = stamp;
    wheels.pose.pose.position.x = 0.05 * i;
    wheels.pose.pose.orientation.w = 1.0;
    bag.write("/wheel_odom", stamp, wheels);
  }
}

/// Prints stamps, completeness and motion inputs of the pairs.
std::string readMovingBag(const std::string& path, const InputParameters& parameters) {
  SourceOptions options;
  apply(parameters, options);
  const std::unique_ptr<Source> source = openSource({path}, options);
  std::ostringstream text;
  text.precision(17);
  while (const auto item = source->next()) {
    const auto& pair = item->assembled.pair;
    text << pair.stamp << (pair.left.empty() ? "" : " left") << (pair.right.empty() ? "" : " right") << "\n";
    for (const LaserInput& each : item->scans)
      text << each.laser << each.scan << each.scan.beams.front().range << each.scan.beams.front().direction.transpose()
           << "\n";
    for (const urban_nav_core::MotionInput& input : item->assembled.inputs)
      text << input.from << "\n" << input.T_from_to.matrix() << "\n" << input.information << "\n";
  }
  for (const urban_nav_core::SpecificForce& sample : source->forces())
    text << sample.stamp << " " << sample.force.transpose() << "\n";
  return text.str();
}

TEST(ParameterEffects, EachParameterChangesWhatIsRead) {
  const testing::TemporaryFolder folder;
  writeMovingBag(folder.file("a.bag"));
  const auto read = [&](const InputParameters& parameters) { return readMovingBag(folder.file("a.bag"), parameters); };
  const std::string faults = urban_nav_core::testing::findParametersWithoutEffect(
      inputTable(), {{"bag",
                      read,
                      {{"motion_input", "wheels"},
                       {"motion_input", "gyroscope"},
                       {"right_delay", 8.0},
                       {"accelerometer_axes", "-y,x,z"},
                       {"accelerometer_scale", 1.01},
                       {"imu_delay", 5.0},
                       {"laser_left_delay", 5.0},
                       {"laser_right_delay", 5.0},
                       {"laser_left_range_scale", 0.5},
                       {"laser_right_range_scale", 0.5},
                       {"laser_left_angle_scale", 0.5},
                       {"laser_right_angle_scale", 0.5}}},
                     {"bag with wheels", read, {{"wheel_noise", 0.5}}, {{"motion_input", "wheels"}}},
                     {"bag with an IMU", read, {{"gyro_noise", 0.5}}, {{"motion_input", "gyroscope"}}}});
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace urban_nav_input
