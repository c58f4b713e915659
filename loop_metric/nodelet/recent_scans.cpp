// SPDX-License-Identifier: BSD-3-Clause
#include "recent_scans.hpp"

#include <algorithm>

#include "urban_nav_core/sequence/time_jump.hpp"
#include "urban_nav_ros/laser_scan.hpp"

namespace loop_metric {

using urban_nav_core::Scan;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs longest = 60'000'000'000;
constexpr std::size_t most = 10000;

}  // namespace

bool RecentScans::add(const sensor_msgs::LaserScan& message) {
  const auto planar = urban_nav_ros::toPlanarScan(message);
  if (!planar) return false;
  Scans& scans = scans_[message.header.frame_id];
  if (!scans.empty() && urban_nav_core::jumpsBack(planar->stamp, scans.back().stamp)) scans.clear();
  if (!scans.empty() && planar->stamp <= scans.back().stamp) return true;  // twice, or late: one among thousands
  scans.push_back(urban_nav_core::toScan(*planar));
  while (scans.size() > most || scans.back().stamp - scans.front().stamp > longest) scans.pop_front();
  return true;
}

std::vector<LaserScans> RecentScans::lasers() const {
  std::vector<LaserScans> lasers;
  for (const auto& each : scans_) {
    const auto T_base_laser = transforms_.lookup(base_frame_, each.first);
    if (!T_base_laser) continue;
    lasers.push_back({*T_base_laser, [&scans = each.second](StampNs first, StampNs last, const auto& take) {
                        const auto begin =
                            std::lower_bound(scans.begin(), scans.end(), first,
                                             [](const Scan& scan, StampNs stamp) { return scan.stamp < stamp; });
                        for (auto scan = begin; scan != scans.end() && scan->stamp <= last; ++scan) take(*scan);
                      }});
  }
  return lasers;
}

std::string RecentScans::unplaced() const {
  for (const auto& each : scans_)
    if (!transforms_.lookup(base_frame_, each.first)) return each.first;
  return {};
}

}  // namespace loop_metric
