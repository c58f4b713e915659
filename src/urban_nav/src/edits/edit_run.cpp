// SPDX-License-Identifier: BSD-3-Clause
#include "edits/edit_run.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "map/map_base.hpp"
#include "map/rendered_poses.hpp"
#include "pose_graph/stored_edits.hpp"
#include "topics/graph/graph_store_export.hpp"

namespace urban_nav {

using urban_nav_core::ClosureVerdict;
using urban_nav_store::EdgeKey;
using urban_nav_store::EditJournal;
using urban_nav_store::Store;
using urban_nav_store::StoredEdit;

namespace {

using Verdicts = std::map<EdgeKey, ClosureVerdict>;

Verdicts storedVerdicts(Store& store, const std::vector<urban_nav_store::SessionId>& ids) {
  Verdicts verdicts;
  for (const urban_nav_store::SessionId& id : ids)
    store.graph().forEachEdge(id, [&](const urban_nav_store::Edge& edge) {
      if (edge.kind != urban_nav_store::EdgeKind::Odometry && !edge.measured.information.isZero(0.0))
        verdicts[edgeKey(edge)] = edge.verdict;
    });
  return verdicts;
}

/// Returns the verdicts of a relaxation, sessions by their ids.
Verdicts relaxedVerdicts(const GraphRun& run, const PreviousSessions& sessions) {
  Verdicts verdicts;
  std::map<std::string, urban_nav_store::SessionId> id;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) id[sessions.names[s]] = sessions.ids[s];
  const auto put = [&](const pose_graph::Closure& closure) {
    verdicts[{id.at(closure.a.session), closure.a.stamp, id.at(closure.b.session), closure.b.stamp, closure.kind,
              closure.source}] = closure.verdict;
  };
  for (const auto& [number, closure] : run.graph.closures()) put(closure);
  for (const pose_graph::Closure& closure : run.rejected_by_hand) put(closure);
  return verdicts;
}

/// Returns the closures contradicted by edits: those accepted before but not after, except edited ones, and those
/// inconsistent with the edits.
std::set<EdgeKey> findContradictions(const Verdicts& before, const Verdicts& after, const GraphRun& run,
                                     const PreviousSessions& sessions, const std::vector<StoredEdit>& edits) {
  std::set<EdgeKey> found;
  std::map<std::string, urban_nav_store::SessionId> id;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) id[sessions.names[s]] = sessions.ids[s];
  const auto toKey = [&](const pose_graph::Closure& closure) {
    return EdgeKey{id.at(closure.a.session), closure.a.stamp, id.at(closure.b.session),
                   closure.b.stamp,          closure.kind,    closure.source};
  };
  for (const auto& [key, verdict] : before) {
    const auto now = after.find(key);
    if (verdict == ClosureVerdict::Accepted && now != after.end() && now->second != ClosureVerdict::Accepted)
      found.insert(key);
  }
  for (const StoredEdit& edit : edits) {
    for (const auto& [number, closure] : run.graph.closures())
      if (toKey(closure) == edgeKey(edit.edge))
        for (const pose_graph::ClosureId other : closure.contradicted_by)
          if (const auto its = run.graph.closures().find(other); its != run.graph.closures().end())
            found.insert(toKey(its->second));
  }
  for (const StoredEdit& edit : edits) found.erase(edgeKey(edit.edge));
  return found;
}

/// Adds the request to the journal, and returns the affected edits.
std::vector<StoredEdit> enter(EditJournal& journal, const EditRequest& request) {
  std::vector<std::int64_t> numbers;
  if (request.action == "undo") numbers = journal.undo(request.count);
  else numbers.push_back(request.action == "redo" ? *journal.redo() : journal.append(request.edit));
  std::vector<StoredEdit> concerned;
  for (const StoredEdit& edit : journal.all())
    if (std::find(numbers.begin(), numbers.end(), edit.number) != numbers.end()) concerned.push_back(edit);
  return concerned;
}

}  // namespace

EditOutcome makeEdit(Store& store, const StoredMeasurements& measurements, const EditRequest& request) {
  EditOutcome outcome;
  outcome.reason = request.unchanged;
  const PreviousSessions& sessions = measurements.sessions;
  const auto edits = [&] { return pose_graph::readEdits(store, sessions.ids, sessions.names); };
  const GraphRun before = relaxEdited(measurements, edits());
  outcome.before = outcome.after = readFigures(before);
  if (!request.unchanged.empty()) return outcome;

  EditJournal journal(store);
  const MapPoses poses_before = storedPoses(store, sessions.ids);
  const Verdicts verdicts_before = storedVerdicts(store, sessions.ids);
  const bool is_first = journal.standing().empty();
  if (is_first && !holdsBase(store) &&
      (comparePoses(poses_before, relaxedPoses(before)).any || verdicts_before != relaxedVerdicts(before, sessions)))
    keepBase(store);
  for (const urban_nav_store::SessionId& id : sessions.ids) noteRenderedPoses(store, id);
  urban_nav_store::storeEdgeNumbers(store);

  const std::vector<StoredEdit> concerned = enter(journal, request);
  const GraphRun after = relaxEdited(measurements, edits());
  if (journal.standing().empty() && holdsBase(store)) restoreBase(store);
  else storeRelaxation(store, sessions.ids, after, sessions.revision);
  urban_nav_store::storeEdgeNumbers(store);
  const Verdicts verdicts_after = storedVerdicts(store, sessions.ids);
  outcome.moved = comparePoses(poses_before, storedPoses(store, sessions.ids));
  const bool is_new = request.action != "undo" && request.action != "redo";  // these change the journal in any case
  if (is_new && !outcome.moved.any && verdicts_before == verdicts_after) {
    store.rollback();
    outcome.reason = "the map does not change: each pose and each verdict is the same without this edit";
    return outcome;
  }
  outcome.changed = true;
  outcome.edit = request.action == "undo" ? concerned.front().number : concerned.back().number;
  outcome.after = readFigures(after);
  const std::map<EdgeKey, std::int64_t> numbers = urban_nav_store::readEdgeNumbers(store);
  for (const auto& [key, verdict] : verdicts_after)
    if (verdicts_before.count(key) == 0) outcome.edge = numbers.at(key);
  for (const EdgeKey& key : findContradictions(verdicts_before, verdicts_after, after, sessions, concerned))
    if (std::get<urban_nav_store::EdgeKind>(key) != urban_nav_store::EdgeKind::Plane && numbers.count(key) > 0)
      outcome.contradicted_by.push_back(numbers.at(key));
  std::sort(outcome.contradicted_by.begin(), outcome.contradicted_by.end());
  outcome.warnings = after.warnings;
  store.commit();
  return outcome;
}

}  // namespace urban_nav
