// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_sim/ros/measurement_messages.hpp"

namespace urban_nav_sim {

namespace {

constexpr std::uint32_t kPointBytes = 22;
constexpr std::uint32_t kIntensityAt = 12, kRingAt = 16, kTimeAt = 18;

void addField(const char* name, std::uint32_t offset, std::uint8_t datatype, sensor_msgs::PointCloud2& cloud) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = datatype;
  field.count = 1;
  cloud.fields.push_back(std::move(field));
}

}  // namespace

sensor_msgs::PointCloud2 toPointsMessage(const LidarMeasurement& lidar) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = urban_nav_ros::toRosTime(lidar.stamp);
  cloud.header.frame_id = urban_nav_core::frames::kLidar3d;
  addField("x", 0, sensor_msgs::PointField::FLOAT32, cloud);
  addField("y", 4, sensor_msgs::PointField::FLOAT32, cloud);
  addField("z", 8, sensor_msgs::PointField::FLOAT32, cloud);
  addField("intensity", kIntensityAt, sensor_msgs::PointField::FLOAT32, cloud);
  addField("ring", kRingAt, sensor_msgs::PointField::UINT16, cloud);
  addField("time", kTimeAt, sensor_msgs::PointField::FLOAT32, cloud);
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(lidar.sweep.beams.size());
  cloud.point_step = kPointBytes;
  cloud.row_step = kPointBytes * cloud.width;
  cloud.is_dense = true;
  cloud.data.resize(cloud.row_step);
  std::uint8_t* point = cloud.data.data();
  for (const urban_nav_core::Beam& beam : lidar.sweep.beams) {
    const Eigen::Vector3f place = beam.range * beam.direction;
    const auto time = static_cast<float>(1e-9 * static_cast<double>(beam.stamp - lidar.stamp));
    std::memcpy(point, place.data(), 3 * sizeof(float));
    std::memcpy(point + kIntensityAt, &beam.intensity, sizeof(float));
    std::memcpy(point + kRingAt, &beam.ring, sizeof(beam.ring));
    std::memcpy(point + kTimeAt, &time, sizeof(time));
    if (!std::isfinite(beam.range)) cloud.is_dense = false;
    point += kPointBytes;
  }
  return cloud;
}

}  // namespace urban_nav_sim
