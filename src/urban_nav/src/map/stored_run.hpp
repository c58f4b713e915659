// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "map/run_fingerprint.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Returns the store keys of sessions, from the content of their inputs. The same input given twice makes two sessions.
std::vector<urban_nav_store::SessionId> sessionIds(const MapOptions& options, const std::vector<MapSession>& sessions);
/// Returns the last part of the path of a session's first input.
std::string inputName(const urban_nav_input::InputSession& session);
/// Returns the fingerprint stored by `map` with a session; empty if another program stored the session.
RunFingerprint storedFingerprint(urban_nav_store::Store& store, const urban_nav_store::SessionId& id);

/// Returns whether the run of `map` that writes a session has not ended; false if another program stored the session.
bool isUnfinished(urban_nav_store::Store& store, const urban_nav_store::Session& session);

struct EdgeWithEvidence {
  urban_nav_store::Edge edge;
  std::optional<std::string> evidence;
};
/// Returns all edges of a session except those of its odometry.
std::vector<EdgeWithEvidence> readClosureEdges(urban_nav_store::Store& store, const urban_nav_store::SessionId& id);
void writeEdges(urban_nav_store::Store& store, const std::vector<EdgeWithEvidence>& edges);

}  // namespace urban_nav
