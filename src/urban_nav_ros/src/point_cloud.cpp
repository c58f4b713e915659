// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/point_cloud.hpp"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <cstring>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using sensor_msgs::PointField;

namespace {

std::uint8_t pointFieldType(const urban_nav_core::PcdField& field) {
  if (field.type == 'F') return field.bytes == 8 ? PointField::FLOAT64 : PointField::FLOAT32;
  if (field.bytes == 1) return PointField::UINT8;
  return field.bytes == 2 ? PointField::UINT16 : PointField::UINT32;
}

constexpr std::uint32_t kIntensityAt = 12, kRingAt = 16, kTimeAt = 18, kSweepPointBytes = 22;

void addSweepField(const char* name, std::uint32_t offset, std::uint8_t datatype, sensor_msgs::PointCloud2& cloud) {
  PointField field;
  field.name = name;
  field.offset = offset;
  field.datatype = datatype;
  field.count = 1;
  cloud.fields.push_back(std::move(field));
}

}  // namespace

sensor_msgs::PointCloud2 toPointCloudMessage(const std::vector<Eigen::Vector4f>& points, const char* fourth) {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier fields(cloud);
  fields.setPointCloud2Fields(4, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1, PointField::FLOAT32,
                              fourth, 1, PointField::FLOAT32);
  fields.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> at(cloud, "x");
  for (const Eigen::Vector4f& point : points) {
    for (int i = 0; i < 4; ++i) at[i] = point[i];
    ++at;
  }
  return cloud;
}

sensor_msgs::PointCloud2 toPointCloudMessage(const std::vector<urban_nav_core::PcdField>& fields,
                                             std::string_view bytes) {
  sensor_msgs::PointCloud2 cloud;
  for (const urban_nav_core::PcdField& each : fields) {
    PointField field;
    field.name = each.name;
    field.offset = cloud.point_step;
    field.datatype = pointFieldType(each);
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += static_cast<std::uint32_t>(each.bytes);
  }
  cloud.data.assign(bytes.begin(), bytes.end());
  cloud.height = 1;
  cloud.width = cloud.point_step == 0 ? 0 : static_cast<std::uint32_t>(bytes.size()) / cloud.point_step;
  cloud.row_step = static_cast<std::uint32_t>(bytes.size());
  cloud.is_dense = 1;
  return cloud;
}

sensor_msgs::PointCloud2 toSweepMessage(const urban_nav_core::Sweep& sweep, urban_nav_core::StampNs stamp) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = toRosTime(stamp);
  addSweepField("x", 0, PointField::FLOAT32, cloud);
  addSweepField("y", 4, PointField::FLOAT32, cloud);
  addSweepField("z", 8, PointField::FLOAT32, cloud);
  addSweepField("intensity", kIntensityAt, PointField::FLOAT32, cloud);
  addSweepField("ring", kRingAt, PointField::UINT16, cloud);
  addSweepField("time", kTimeAt, PointField::FLOAT32, cloud);
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(sweep.beams.size());
  cloud.point_step = kSweepPointBytes;
  cloud.row_step = kSweepPointBytes * cloud.width;
  cloud.is_dense = true;
  cloud.data.resize(cloud.row_step);
  std::uint8_t* point = cloud.data.data();
  for (const urban_nav_core::Beam& beam : sweep.beams) {
    const Eigen::Vector3f end = beam.range * beam.direction;
    const auto time = static_cast<float>(1e-9 * static_cast<double>(beam.stamp - stamp));
    std::memcpy(point, end.data(), 3 * sizeof(float));
    std::memcpy(point + kIntensityAt, &beam.intensity, sizeof(float));
    std::memcpy(point + kRingAt, &beam.ring, sizeof(beam.ring));
    std::memcpy(point + kTimeAt, &time, sizeof(time));
    if (!std::isfinite(beam.range)) cloud.is_dense = false;
    point += kSweepPointBytes;
  }
  return cloud;
}

}  // namespace urban_nav_ros
