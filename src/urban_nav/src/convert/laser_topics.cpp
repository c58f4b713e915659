// SPDX-License-Identifier: BSD-3-Clause
#include "convert/laser_topics.hpp"

#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

void writeLaser(const std::string& side, const urban_nav_core::PlanarScan& scan, std::uint32_t id, BagWriter& bag) {
  sensor_msgs::LaserScan message = urban_nav_ros::toLaserScanMessage(scan, "laser_" + side);
  message.header.seq = id;
  namespace topics = urban_nav_ros::topics;
  bag.write(topics::fromRoot(side == "left" ? topics::kLaserLeft : topics::kLaserRight), scan.stamp, message);
}

}  // namespace urban_nav
