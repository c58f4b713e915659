// SPDX-License-Identifier: BSD-3-Clause
#include "mounted_laser.hpp"

#include <algorithm>

namespace laser_mapper {

namespace {

std::vector<MountedLaser> sortedByFrame(std::vector<MountedLaser> lasers) {
  std::sort(lasers.begin(), lasers.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
  return lasers;
}

}  // namespace

std::vector<MountedLaser> statedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  return sortedByFrame(urban_nav_registration::statedLasers(store, session));
}

std::vector<MountedLaser> mountedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  return sortedByFrame(urban_nav_registration::storedLasers(store, session));
}

}  // namespace laser_mapper
