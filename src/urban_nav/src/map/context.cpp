// SPDX-License-Identifier: BSD-3-Clause
#include "map/context.hpp"

#include "urban_nav_registration/session/calibration_fingerprint.hpp"

namespace urban_nav {

std::vector<const SessionOdometry*> MapContext::runs() const {
  std::vector<const SessionOdometry*> all;
  for (const SessionOdometry& run : previous.runs) all.push_back(&run);
  for (const MapSession& session : sessions) all.push_back(session.odometry.get());
  return all;
}

std::vector<urban_nav_store::SessionId> MapContext::ids() const {
  std::vector<urban_nav_store::SessionId> all = previous.ids;
  for (const MapSession& session : sessions) all.push_back(session.id);
  return all;
}

std::optional<urban_nav_registration::MountedCamera> MapContext::lastCamera() const {
  for (auto session = sessions.rbegin(); session != sessions.rend(); ++session)
    if (session->info.has_images)
      return urban_nav_registration::MountedCamera{session->info.camera, session->info.T_base_camera};
  for (auto run = previous.runs.rbegin(); run != previous.runs.rend(); ++run)
    if (auto camera = urban_nav_registration::parseCalibrationFingerprint(run->cameras)) return camera;
  return std::nullopt;
}

}  // namespace urban_nav
