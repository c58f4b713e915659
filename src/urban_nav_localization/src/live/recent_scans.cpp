// SPDX-License-Identifier: BSD-3-Clause
#include "live/recent_scans.hpp"

#include <algorithm>

#include "urban_nav_core/sequence/time_jump.hpp"

namespace urban_nav_localization {

using urban_nav_core::Scan;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kMaxAge = 60'000'000'000;  // ns
constexpr std::size_t kMaxScans = 10000;

}  // namespace

void RecentScans::add(const std::string& frame, Scan scan) {
  std::deque<Scan>& scans = lasers_[frame].scans;
  if (!scans.empty() && urban_nav_core::jumpsBack(scan.stamp, scans.back().stamp)) scans.clear();
  if (!scans.empty() && scan.stamp <= scans.back().stamp) return;  // one among thousands
  scans.push_back(std::move(scan));
  while (scans.size() > kMaxScans || scans.back().stamp - scans.front().stamp > kMaxAge) scans.pop_front();
}

void RecentScans::setLaser(const std::string& frame, const urban_nav_core::Pose& T_base_laser) {
  lasers_[frame].T_base_laser = T_base_laser;
}

std::vector<urban_nav_registration::LaserScans> RecentScans::lasers() const {
  std::vector<urban_nav_registration::LaserScans> lasers;
  for (const auto& each : lasers_) {
    if (!each.second.T_base_laser) continue;
    lasers.push_back(
        {*each.second.T_base_laser, [&scans = each.second.scans](StampNs first, StampNs last, const auto& take) {
           const auto begin = std::lower_bound(scans.begin(), scans.end(), first,
                                               [](const Scan& scan, StampNs stamp) { return scan.stamp < stamp; });
           for (auto scan = begin; scan != scans.end() && scan->stamp <= last; ++scan) take(*scan);
         }});
  }
  return lasers;
}

std::vector<std::string> RecentScans::unplaced() const {
  std::vector<std::string> frames;
  for (const auto& [frame, laser] : lasers_)
    if (!laser.T_base_laser) frames.push_back(frame);
  return frames;
}

}  // namespace urban_nav_localization
