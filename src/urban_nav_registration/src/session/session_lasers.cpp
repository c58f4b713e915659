// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/session_lasers.hpp"

#include <algorithm>

#include "urban_nav_registration/session/adopted_calibration.hpp"

namespace urban_nav_registration {

using urban_nav_core::StampNs;
using urban_nav_store::SessionId;

std::vector<LaserAt> statedLasers(urban_nav_store::Store& store, const SessionId& session) {
  std::vector<LaserAt> found;
  const std::vector<std::string> lasers = store.scans().lasers(session);
  for (const urban_nav_store::Extrinsic& extrinsic : store.sessions().extrinsics(session))
    if (std::find(lasers.begin(), lasers.end(), extrinsic.frame) != lasers.end())
      found.push_back({extrinsic.frame, extrinsic.T_base_frame, 0});
  return found;
}

std::vector<LaserAt> storedLasers(urban_nav_store::Store& store, const SessionId& session) {
  std::vector<LaserAt> lasers = statedLasers(store, session);
  for (const AdoptedCalibration& adopted : readCalibration(store, session))
    for (LaserAt& laser : lasers)
      if (laser.frame == adopted.frame) {
        laser.T_base_laser = laser.T_base_laser * adopted.T_stated_adopted;
        laser.delay = adopted.delay;
      }
  return lasers;
}

urban_nav_core::Scan withoutDelay(urban_nav_core::Scan scan, StampNs delay) {
  scan.stamp -= delay;
  for (urban_nav_core::Beam& beam : scan.beams) beam.stamp -= delay;
  return scan;
}

std::vector<LaserScans> storedScans(const urban_nav_store::ScanStore& scans, const SessionId& session,
                                    const std::vector<LaserAt>& lasers) {
  std::vector<LaserScans> readers;
  for (const LaserAt& laser : lasers)
    readers.push_back({laser.T_base_laser, [&scans, session, laser](StampNs first, StampNs last, const auto& take) {
                         if (laser.delay == 0) return scans.forEach(session, laser.frame, first, last, take);
                         scans.forEach(
                             session, laser.frame, first + laser.delay, last + laser.delay,
                             [&](urban_nav_core::Scan scan) { take(withoutDelay(std::move(scan), laser.delay)); });
                       }});
  return readers;
}

}  // namespace urban_nav_registration
