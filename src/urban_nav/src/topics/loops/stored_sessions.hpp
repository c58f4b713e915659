// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loop_metric/place/stored_place_data.hpp"
#include "map/session_odometry.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// A session that candidates may refer to.
struct CandidateSession {
  std::string name;  ///< in closures.csv
  urban_nav_store::SessionId id;
  const SessionOdometry* run = nullptr;
};

/// Returns the input of loop_metric for sessions whose keyframes and scans are in `store`. `camera`: camera to which
/// keyframes of other cameras are converted; nullopt: keyframes are not needed.
loop_metric::StoredPlaceData::Sessions storedSessions(
    const std::vector<CandidateSession>& sessions, urban_nav_store::Store& store,
    const std::optional<urban_nav_registration::MountedCamera>& camera);

}  // namespace urban_nav
