// SPDX-License-Identifier: BSD-3-Clause
#include "map/context.hpp"

#include "urban_nav_core/types/error.hpp"
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

urban_nav_registration::MountedCamera MapContext::lastCamera() const {
  if (!sessions.empty()) return {sessions.back().info.camera, sessions.back().info.T_base_camera};
  const SessionOdometry& last = previous.runs.back();
  const auto camera = urban_nav_registration::parseCalibrationFingerprint(last.cameras);
  if (!camera)
    throw urban_nav_core::DataError(store->path(), "does not hold the camera of session " + previous.ids.back(),
                                    "a store that map has written");
  return *camera;
}

}  // namespace urban_nav
