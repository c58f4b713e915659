// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loop_metric/place/stored_place_data.hpp"
#include "map/session_odometry.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// A session that candidates may name.
struct CandidateSession {
  std::string name;  ///< as closures.csv has it
  urban_nav_store::SessionId id;
  const SessionOdometry* run = nullptr;
};

/// Returns what loop_metric needs of sessions whose keyframes and scans are in `store`. `camera`: to which keyframes of
/// other cameras are converted; nullopt: keyframes are not needed.
loop_metric::StoredPlaceData::Sessions storedSessions(
    const std::vector<CandidateSession>& sessions, urban_nav_store::Store& store,
    const std::optional<urban_nav_registration::MountedCamera>& camera);

}  // namespace urban_nav
