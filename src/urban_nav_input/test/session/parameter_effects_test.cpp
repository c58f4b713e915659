// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>

#include <cmath>
#include <cstring>
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
  scan.angle_max = 1.2F;
  scan.time_increment = 0.001F;
  scan.range_max = 80.0F;
  scan.ranges.assign(10, 4.0F);
  return scan;
}

/// A turn of a LiDAR with four rings; times of the points in s in the field `time`, and their negation in `before`.
sensor_msgs::PointCloud2 cloudAt(const ros::Time& stamp, const std::string& frame) {
  constexpr std::uint32_t kPoints = 400;
  const char* names[] = {"x", "y", "z", "time", "before"};
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = stamp;
  cloud.header.frame_id = frame;
  cloud.width = kPoints;
  cloud.height = 1;
  cloud.point_step = 20;
  cloud.row_step = cloud.point_step * kPoints;
  for (std::uint32_t i = 0; i < 5; ++i) {
    sensor_msgs::PointField field;
    field.name = names[i];
    field.offset = 4 * i;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.data.resize(cloud.row_step);
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const float share = (static_cast<float>(i) + 0.5F) / kPoints, azimuth = 6.2831853F * (0.5F - share);
    const float range = i % 10 == 0 ? 0.8F : 6.0F;
    const float point[] = {range * std::cos(azimuth), range * std::sin(azimuth),
                           0.1F * static_cast<float>(i % 4) * range, 0.05F * share, 0.05F * (share - 1.0F)};
    std::memcpy(&cloud.data[i * cloud.point_step], point, sizeof(point));
  }
  return cloud;
}

/// A bag whose right images are stamped 8 ms late, with wheels, an IMU, two lasers and two LiDARs.
void writeMovingBag(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "imu_link", urban_nav_core::Pose()));
  for (const char* laser : {"laser_left", "laser_right", "lidar_a", "lidar_b"})
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
    for (const std::string lidar : {"lidar_a", "lidar_b"})
      bag.write("/" + lidar + "/points", stamp, cloudAt(stamp, lidar));
    nav_msgs::Odometry wheels;
    wheels.header.stamp = stamp;
    wheels.pose.pose.position.x = 0.05 * i;
    wheels.pose.pose.orientation.w = 1.0;
    bag.write("/wheel_odom", stamp, wheels);
  }
}

/// A bag with a horizontal laser alone.
void writeScanBag(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(urban_nav_ros::toStaticTransform("base_link", "laser", urban_nav_core::Pose()));
  bag.write("/tf_static", ros::Time(1.5e9), transforms);
  for (int i = 0; i < 12; ++i) {
    const ros::Time stamp(1.5e9 + 0.05 * i);
    for (const char* topic : {"/scan", "/scan_1", "/scan_2", "/scan_3"})
      bag.write(topic, stamp, scanAt(stamp, "laser"));
  }
}

/// Prints stamps, completeness and motion inputs of the pairs.
std::string readMovingBag(const std::string& path, const InputParameters& parameters) {
  SourceOptions options;
  options.with_sweeps = true;
  apply(parameters, options);
  const std::unique_ptr<Source> source = openSource({path}, options);
  std::ostringstream text;
  text.precision(17);
  text << source->info().camera << "\n";
  while (const auto item = source->next()) {
    const auto& pair = item->assembled.pair;
    text << pair.stamp << (pair.left.empty() ? "" : " left") << (pair.right.empty() ? "" : " right") << "\n";
    for (const LaserInput& each : item->scans)
      text << each.laser << each.scan << each.scan.beams.front().range << each.scan.beams.front().direction.transpose()
           << each.scan.beams.back().stamp << "\n";
    for (const SweepInput& each : item->sweeps)
      text << each.role << " " << each.sweep.reference << " " << static_cast<int>(each.sweep.times) << " "
           << each.sweep.beams.size() << " " << each.sweep.beams.front().stamp << "\n";
    for (const urban_nav_core::MotionInput& input : item->assembled.inputs)
      text << input.from << "\n" << input.T_from_to.matrix() << "\n" << input.information << "\n";
  }
  for (const urban_nav_core::SpecificForce& sample : source->forces())
    text << sample.stamp << " " << sample.force.transpose() << "\n";
  return text.str();
}

/// Returns a changed value of each parameter of the further planar lasers.
std::vector<urban_nav_core::testing::ParameterChange> changesOfLasers() {
  std::vector<urban_nav_core::testing::ParameterChange> changes;
  for (const std::string laser : {"laser0", "laser1", "laser2", "laser3"}) {
    changes.push_back({laser + "_delay", 5.0});
    for (const char* scale : {"_range_scale", "_angle_scale", "_time_scale"}) changes.push_back({laser + scale, 0.5});
  }
  return changes;
}

TEST(ParameterEffects, EachParameterChangesWhatIsRead) {
  const testing::TemporaryFolder folder;
  writeMovingBag(folder.file("a.bag"));
  writeScanBag(folder.file("scan.bag"));
  const auto read_scans = [&](const InputParameters& parameters) {
    return readMovingBag(folder.file("scan.bag"), parameters);
  };
  const auto read = [&](const InputParameters& parameters) { return readMovingBag(folder.file("a.bag"), parameters); };
  const std::string faults = urban_nav_core::testing::findParametersWithoutEffect(
      inputTable(),
      {{"bag",
        read,
        {{"motion_input", "wheels"},
         {"motion_input", "gyroscope"},
         {"right_delay", 8.0},
         {"pairing_tolerance", 9.0},
         {"baseline_scale", 0.5},
         {"accelerometer_axes", "-y,x,z"},
         {"accelerometer_scale", 1.01},
         {"imu_delay", 5.0},
         {"laser_left_delay", 5.0},
         {"laser_right_delay", 5.0},
         {"laser_left_range_scale", 0.5},
         {"laser_right_range_scale", 0.5},
         {"laser_left_angle_scale", 0.5},
         {"laser_right_angle_scale", 0.5},
         {"laser_left_time_scale", 0.5},
         {"laser_right_time_scale", 0.5},
         {"points_time", "before,s,header"},
         {"points_deskewed", "yes"},
         {"points_near", 2.0},
         {"points0_delay", 5.0},
         {"points1_delay", 5.0}}},
       {"bag with wheels",
        read,
        {{"wheel_noise", 0.5}, {"wheels_scale", -1.0}, {"wheels_delay", 5.0}},
        {{"motion_input", "wheels"}}},
       {"bag with a horizontal laser", read_scans, changesOfLasers()},
       {"bag with an IMU", read, {{"gyro_noise", 0.5}, {"gyroscope_scale", 0.5}}, {{"motion_input", "gyroscope"}}}},
      {{"sessions", "ForeignBags.TheUserStatesWhichRecordingsFormASession"},
       {"gps_delay", "BagFixes.AreMeasuredEarlierByTheDelay"}});
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace urban_nav_input
