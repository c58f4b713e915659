// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/laser_scan.hpp"

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

sensor_msgs::LaserScan toLaserScanMessage(const urban_nav_core::PlanarScan& scan, const std::string& frame) {
  sensor_msgs::LaserScan message;
  message.header.stamp = toRosTime(scan.stamp);
  message.header.frame_id = frame;
  message.angle_min = static_cast<float>(scan.angle_first);
  message.angle_increment = static_cast<float>(scan.angle_step);
  message.angle_max =
      static_cast<float>(scan.angle_first + scan.angle_step * static_cast<double>(scan.ranges.size() - 1));
  message.time_increment = static_cast<float>(scan.time_step);
  message.scan_time = static_cast<float>(scan.period);
  message.range_min = static_cast<float>(scan.range_min);
  message.range_max = static_cast<float>(scan.range_max);
  message.ranges = scan.ranges;
  message.intensities = scan.intensities;
  return message;
}

}  // namespace urban_nav_ros
