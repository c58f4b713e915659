// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "loop_metric/place/stored_place_data.hpp"
#include "stage/vo_run.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// A session that candidates may name.
struct CandidateSession {
  std::string name;  ///< as closures.csv has it
  urban_nav_store::SessionId id;
  const VoRun* run = nullptr;
};

/// Returns what loop_metric needs of sessions whose keyframes and scans are in `store`. `camera`: its fingerprint;
/// sessions of another camera have no keyframes.
loop_metric::StoredPlaceData::Sessions storedSessions(const std::vector<CandidateSession>& sessions,
                                                      urban_nav_store::Store& store, const std::string& camera);

}  // namespace urban_nav
