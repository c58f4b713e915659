// SPDX-License-Identifier: BSD-3-Clause
#include "mounted_laser.hpp"

#include <algorithm>

#include "calibration/calibration_state.hpp"
#include "urban_nav_registration/session/session_lasers.hpp"

namespace laser_mapper {

std::vector<MountedLaser> statedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  std::vector<MountedLaser> lasers;
  for (const urban_nav_registration::LaserAt& laser : urban_nav_registration::storedLasers(store, session))
    lasers.push_back({laser.frame, laser.T_base_laser, 0});
  std::sort(lasers.begin(), lasers.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
  return lasers;
}

std::vector<MountedLaser> mountedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  std::vector<MountedLaser> lasers = statedLasers(store, session);
  const auto bytes = store.states().get(session, kCalibrationState);
  if (!bytes) return lasers;
  for (const AdoptedCalibration& adopted : unpackCalibration(*bytes))
    for (MountedLaser& laser : lasers)
      if (laser.frame == adopted.frame) {
        laser.T_base_laser = laser.T_base_laser * adopted.T_stated_laser;
        laser.delay = adopted.delay;
      }
  return lasers;
}

}  // namespace laser_mapper
