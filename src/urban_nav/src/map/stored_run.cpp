// SPDX-License-Identifier: BSD-3-Clause
#include "map/stored_run.hpp"

#include <algorithm>
#include <filesystem>

#include "map/store_keys.hpp"

namespace urban_nav {

using urban_nav_store::Edge;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

std::vector<SessionId> sessionIds(const MapOptions& options, const std::vector<MapSession>& sessions) {
  std::vector<SessionId> ids;
  for (const MapSession& session : sessions) {
    urban_nav_store::SessionOrigin of_session = origin(options, session.input);
    SessionId id = makeSessionId(of_session);
    for (int again = 2; std::find(ids.begin(), ids.end(), id) != ids.end(); ++again) {
      of_session.recording = std::to_string(again);
      id = makeSessionId(of_session);
    }
    ids.push_back(id);
  }
  return ids;
}

std::string inputName(const urban_nav_input::InputSession& session) {
  const std::filesystem::path path = std::filesystem::absolute(session.paths.front()).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

RunFingerprint storedFingerprint(Store& store, const SessionId& id) {
  RunFingerprint fingerprint;
  for (const urban_nav_store::Property& property : store.sessions().properties(id))
    if (property.name.rfind("run/", 0) == 0) fingerprint.emplace_back(property.name.substr(4), property.value);
  return fingerprint;
}

bool isUnfinished(Store& store, const urban_nav_store::Session& session) {
  if (storedFingerprint(store, session.id).empty()) return false;
  const std::vector<std::string> stages = store.states().stages(session.id);
  return !session.complete || std::any_of(stages.begin(), stages.end(), [](const std::string& stage) {
    return stage == kVoStage || stage == kLoStage || stage == kRunStage;
  });
}

std::vector<EdgeWithEvidence> readClosureEdges(Store& store, const SessionId& id) {
  std::vector<EdgeWithEvidence> edges;
  for (const urban_nav_store::Session& session : store.sessions().all())
    store.graph().forEachEdge(session.id, [&](const Edge& edge) {
      if (edge.kind != urban_nav_store::EdgeKind::Odometry && (edge.a.session == id || edge.b.session == id))
        edges.push_back({edge, std::nullopt});
    });
  for (EdgeWithEvidence& each : edges) each.evidence = store.graph().evidence(each.edge);
  return edges;
}

void writeEdges(Store& store, const std::vector<EdgeWithEvidence>& edges) {
  for (const EdgeWithEvidence& each : edges) {
    store.graph().put(each.edge);
    if (each.evidence) store.graph().putEvidence(each.edge, *each.evidence);
  }
}

}  // namespace urban_nav
