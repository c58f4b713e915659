// SPDX-License-Identifier: BSD-3-Clause
#include "map_messages.hpp"

#include "laser_mapper/map_files.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace laser_mapper {

using sensor_msgs::PointField;

namespace {

std::uint8_t pointFieldType(const urban_nav_core::PcdField& field) {
  if (field.type == 'F') return field.bytes == 8 ? PointField::FLOAT64 : PointField::FLOAT32;
  if (field.bytes == 1) return PointField::UINT8;
  return field.bytes == 2 ? PointField::UINT16 : PointField::UINT32;
}

/// The points with all that a PCD file of the map has.
sensor_msgs::PointCloud2 wholePoints(const std::vector<MapPoint>& points) {
  sensor_msgs::PointCloud2 cloud;
  for (const urban_nav_core::PcdField& each : mapPcdFields()) {
    PointField field;
    field.name = each.name;
    field.offset = cloud.point_step;
    field.datatype = pointFieldType(each);
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += static_cast<std::uint32_t>(each.bytes);
  }
  std::string bytes;
  for (const MapPoint& point : points) appendPcdPoint(bytes, point);
  cloud.data.assign(bytes.begin(), bytes.end());
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.row_step = static_cast<std::uint32_t>(bytes.size());
  cloud.is_dense = 1;
  return cloud;
}

std_msgs::Header mapHeader(const std::string& frame, urban_nav_core::StampNs stamp) {
  std_msgs::Header header;
  header.frame_id = frame;
  header.stamp = urban_nav_ros::toRosTime(stamp);
  return header;
}

}  // namespace

urban_nav_msgs::MapTile toMapTileMessage(const LiveMap::ChangedTile& tile, double voxel, const std::string& frame,
                                         urban_nav_core::StampNs stamp) {
  urban_nav_msgs::MapTile message;
  message.header = mapHeader(frame, stamp);
  message.x = tile.tile.x;
  message.y = tile.tile.y;
  message.edge = kTileCells * voxel;
  message.revision = tile.revision;
  message.points = wholePoints(tile.points);
  message.points.header = message.header;
  return message;
}

urban_nav_msgs::MapQuality toMapQualityMessage(const MapQuality& quality, const std::string& frame,
                                               urban_nav_core::StampNs stamp) {
  urban_nav_msgs::MapQuality message;
  message.header = mapHeader(frame, stamp);
  const QualityFigures walls = quality.walls();
  message.walls = static_cast<std::uint32_t>(walls.places);
  message.wall_pairs = static_cast<std::uint32_t>(walls.pairs);
  message.angle_mean = walls.angle.mean;
  message.displacement_mean = walls.displacement.mean;
  message.displacement_max = walls.displacement.largest;
  for (const PlanePlace& place : quality.places()) {
    geometry_msgs::Point centre;
    centre.x = place.centre.x();
    centre.y = place.centre.y();
    centre.z = place.centre.z();
    geometry_msgs::Vector3 normal;
    normal.x = place.normal.x();
    normal.y = place.normal.y();
    normal.z = place.normal.z();
    message.places.push_back(centre);
    message.normals.push_back(normal);
    message.passes.push_back(static_cast<std::uint32_t>(place.patches.size()));
    message.angles.push_back(place.angle);
    message.displacements.push_back(place.displacement);
    message.displacement_sigmas.push_back(place.displacement_sigma);
  }
  return message;
}

}  // namespace laser_mapper
