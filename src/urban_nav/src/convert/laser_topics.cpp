// SPDX-License-Identifier: BSD-3-Clause
#include "convert/laser_topics.hpp"

#include <sensor_msgs/LaserScan.h>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

void writeLaser(const std::string& side, const urban_nav_core::PlanarScan& scan, std::uint32_t id, BagWriter& bag) {
  sensor_msgs::LaserScan message;
  message.header.stamp = urban_nav_ros::toRosTime(scan.stamp);
  message.header.frame_id = "laser_" + side;
  message.header.seq = id;
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
  bag.write("/laser_" + side + "/scan", scan.stamp, message);
}

}  // namespace urban_nav
