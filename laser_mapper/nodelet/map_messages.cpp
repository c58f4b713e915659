// SPDX-License-Identifier: BSD-3-Clause
#include "map_messages.hpp"

#include "laser_mapper/map_files.hpp"
#include "urban_nav_ros/point_cloud.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace laser_mapper {

namespace {

/// Returns the points with all fields of a PCD file of the map.
sensor_msgs::PointCloud2 wholePoints(const std::vector<MapPoint>& points) {
  std::string bytes;
  for (const MapPoint& point : points) appendPcdPoint(bytes, point);
  return urban_nav_ros::toPointCloudMessage(mapPcdFields(), bytes);
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
