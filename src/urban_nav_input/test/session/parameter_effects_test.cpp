// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>

#include <sstream>

#include "urban_nav_input/session/input_parameters.hpp"
#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {
namespace {

/// A bag whose right images are stamped 8 ms late, with wheels and an IMU.
void writeMovingBag(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "imu_link", urban_nav_core::Pose()));
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
    bag.write("/imu/data", stamp, imu);
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
  options.motion_input = parameters.motion_input;
  options.wheel_noise = parameters.wheel_noise;
  options.gyro_noise = parameters.gyro_noise;
  options.right_delay = parameters.right_delay;
  const std::unique_ptr<Source> source = openSource({path}, options);
  std::ostringstream text;
  text.precision(17);
  while (const auto item = source->next()) {
    const auto& pair = item->assembled.pair;
    text << pair.stamp << (pair.left.empty() ? "" : " left") << (pair.right.empty() ? "" : " right") << "\n";
    for (const urban_nav_core::MotionInput& input : item->assembled.inputs)
      text << input.from << "\n" << input.T_from_to.matrix() << "\n" << input.information << "\n";
  }
  return text.str();
}

TEST(ParameterEffects, EachParameterChangesWhatIsRead) {
  const testing::TemporaryFolder folder;
  writeMovingBag(folder.file("a.bag"));
  const auto read = [&](const InputParameters& parameters) { return readMovingBag(folder.file("a.bag"), parameters); };
  const std::string faults = urban_nav_core::testing::findParametersWithoutEffect(
      inputTable(), {{"bag", read, {{"motion_input", "wheels"}, {"motion_input", "gyroscope"}, {"right_delay", 8.0}}},
                     {"bag with wheels", read, {{"wheel_noise", 0.5}}, {{"motion_input", "wheels"}}},
                     {"bag with an IMU", read, {{"gyro_noise", 0.5}}, {{"motion_input", "gyroscope"}}}});
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace urban_nav_input
