// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/session_lasers.hpp"

#include <algorithm>

namespace urban_nav_registration {

using urban_nav_core::StampNs;
using urban_nav_store::SessionId;

std::vector<LaserAt> storedLasers(urban_nav_store::Store& store, const SessionId& session) {
  std::vector<LaserAt> found;
  const std::vector<std::string> lasers = store.scans().lasers(session);
  for (const urban_nav_store::Extrinsic& extrinsic : store.sessions().extrinsics(session))
    if (std::find(lasers.begin(), lasers.end(), extrinsic.frame) != lasers.end())
      found.push_back({extrinsic.frame, extrinsic.T_base_frame});
  return found;
}

std::vector<LaserScans> storedScans(const urban_nav_store::ScanStore& scans, const SessionId& session,
                                    const std::vector<LaserAt>& lasers) {
  std::vector<LaserScans> readers;
  for (const LaserAt& laser : lasers)
    readers.push_back(
        {laser.T_base_laser, [&scans, session, frame = laser.frame](StampNs first, StampNs last, const auto& take) {
           scans.forEach(session, frame, first, last, take);
         }});
  return readers;
}

}  // namespace urban_nav_registration
