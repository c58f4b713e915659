// SPDX-License-Identifier: BSD-3-Clause
#include "recording/bag_groups.hpp"

#include <rosbag/view.h>

#include <algorithm>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

std::vector<BagGroup> groupBags(std::list<rosbag::Bag>& bags) {
  std::vector<BagGroup> groups;
  std::size_t count = 0;
  for (rosbag::Bag& bag : bags) {
    rosbag::View all(bag);
    const bool empty = all.size() == 0;
    if (groups.empty() || (!empty && urban_nav_ros::toStampNs(all.getBeginTime()) > groups.back().receipt))
      groups.emplace_back();
    BagGroup& group = groups.back();
    group.bags.push_back(&bag);
    group.end = ++count;
    if (!empty) group.receipt = std::max(group.receipt, urban_nav_ros::toStampNs(all.getEndTime()));
  }
  return groups;
}

std::vector<BagGroup> asOneGroup(const std::vector<BagGroup>& groups) {
  BagGroup all;
  for (const BagGroup& group : groups) {
    all.bags.insert(all.bags.end(), group.bags.begin(), group.bags.end());
    all.end = group.end;
    all.receipt = std::max(all.receipt, group.receipt);
  }
  return {all};
}

}  // namespace urban_nav_input
