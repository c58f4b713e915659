// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/grid_message.hpp"

#include <utility>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

nav_msgs::OccupancyGrid toGridMessage(const GridCells& cells, std::vector<std::int8_t> values, const std::string& frame,
                                      urban_nav_core::StampNs stamp) {
  nav_msgs::OccupancyGrid message;
  message.header.frame_id = frame;
  message.header.stamp = message.info.map_load_time = toRosTime(stamp);
  message.info.resolution = static_cast<float>(cells.cell);
  message.info.width = static_cast<std::uint32_t>(cells.width);
  message.info.height = static_cast<std::uint32_t>(cells.height);
  message.info.origin.position.x = cells.x0;
  message.info.origin.position.y = cells.y0;
  message.info.origin.orientation.w = 1.0;
  message.data = std::move(values);
  return message;
}

}  // namespace urban_nav_ros
