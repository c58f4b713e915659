// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/stored_sessions.hpp"

#include <memory>

#include "map/session_odometry.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_registration/session/stored_beams.hpp"

namespace urban_nav {

loop_metric::StoredPlaceData::Sessions storedSessions(
    const std::vector<CandidateSession>& sessions, urban_nav_store::Store& store,
    const std::optional<urban_nav_registration::MountedCamera>& camera) {
  loop_metric::StoredPlaceData::Sessions made;
  for (const CandidateSession& session : sessions) {
    loop_metric::StoredSession& its = made[session.name];
    its.id = session.id;
    its.odometry = std::make_shared<urban_nav_core::OdometryChain>(odometryChain(*session.run));
    its.has_camera = false;
    for (const urban_nav_store::Property& property : store.sessions().properties(session.id))
      if (camera && property.name == urban_nav_registration::kCalibrationProperty)
        its.conversion = urban_nav_registration::findConversion(property.value, *camera, its.has_camera);
    its.lasers = urban_nav_registration::storedBeamSources(store, session.id);
  }
  return made;
}

}  // namespace urban_nav
