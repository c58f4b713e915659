// SPDX-License-Identifier: BSD-3-Clause
#include "live/recent_sweeps.hpp"

#include "urban_nav_core/sequence/time_jump.hpp"
#include "urban_nav_store/tables/lidar_sweep.hpp"

namespace urban_nav_localization {

using urban_nav_core::Scan;
using urban_nav_core::StampNs;
using urban_nav_store::LidarSweep;

namespace {

constexpr std::size_t kMaxSweeps = 80;  // of a LiDAR: 20 m of driving, 30 MB of 128 000 beams each

}  // namespace

void RecentSweeps::add(const std::string& frame, const urban_nav_core::Sweep& sweep,
                       const std::optional<urban_nav_core::Pose>& T_odom_base) {
  Lidar& lidar = lidars_[frame];
  if (!lidar.sweeps.empty() && urban_nav_core::jumpsBack(sweep.reference, lidar.sweeps.back().first))
    lidar.sweeps.clear();
  if (!lidar.sweeps.empty() && sweep.reference <= lidar.sweeps.back().first) return;
  if (!lidar.spacing.takes(sweep.reference, T_odom_base)) return;
  lidar.sweeps.emplace_back(sweep.reference, LidarSweep::pack(sweep));
  if (lidar.sweeps.size() > kMaxSweeps) lidar.sweeps.pop_front();
}

void RecentSweeps::setLidar(const std::string& frame, const urban_nav_core::Pose& T_base_lidar) {
  const auto lidar = lidars_.find(frame);
  if (lidar != lidars_.end()) lidar->second.T_base_lidar = T_base_lidar;
}

std::vector<urban_nav_registration::LaserScans> RecentSweeps::lidars() const {
  std::vector<urban_nav_registration::LaserScans> lidars;
  for (const auto& each : lidars_) {
    if (!each.second.T_base_lidar) continue;
    lidars.push_back(
        {*each.second.T_base_lidar, [&sweeps = each.second.sweeps](StampNs first, StampNs last, const auto& take) {
           for (const auto& [reference, packed] : sweeps) {
             if (reference < first || reference > last) continue;
             for (const Scan& ring : LidarSweep{"", "", reference, packed}.rings()) take(ring);
           }
         }});
  }
  return lidars;
}

std::vector<std::string> RecentSweeps::unplaced() const {
  std::vector<std::string> frames;
  for (const auto& [frame, lidar] : lidars_)
    if (!lidar.T_base_lidar) frames.push_back(frame);
  return frames;
}

}  // namespace urban_nav_localization
