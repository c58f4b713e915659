// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/store_results.hpp"

#include <algorithm>
#include <optional>

#include "inspect/store_export.hpp"
#include "map/previous_sessions.hpp"
#include "map/stage_result.hpp"
#include "map/trajectory_files.hpp"
#include "urban_nav/stored_results.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/deflate.hpp"
#include "urban_nav_store/stored_map.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_graph.hpp"

namespace urban_nav {

using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr std::size_t kMostGraph = std::size_t{1} << 32;  // bytes of graph.g2o

/// Returns poses and covariances of stored sessions in the form used by `map` for its files.
std::vector<SessionTrajectory> storedTrajectories(Store& store, const PreviousSessions& sessions,
                                                  std::vector<std::string>& left_out) {
  std::vector<SessionTrajectory> trajectories;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) {
    const urban_nav_store::Session session = *store.sessions().find(sessions.ids[s]);
    const urban_nav_store::StoredTrajectory stored = readTrajectory(store, session);
    SessionTrajectory trajectory;
    trajectory.map = static_cast<std::size_t>(std::find(sessions.ids.begin(), sessions.ids.end(), stored.map) -
                                              sessions.ids.begin());
    if (trajectory.map == sessions.ids.size()) trajectory.map = s;
    trajectory.written = true;
    for (const urban_nav_core::StampedPose& pose : stored.T_map_base)
      trajectory.T_map_base.append(pose.stamp, pose.pose);
    trajectory.covariances = readStoredCovariances(store, session.id).poses;
    if (trajectory.covariances.empty())
      left_out.push_back("rows of session " + sessions.names[s] +
                         " in covariance.csv: the store was written live, or by an earlier version, and holds none");
    trajectories.push_back(std::move(trajectory));
  }
  return trajectories;
}

/// Adds the graphs of sessions that were not relaxed: odometry only, in separate files.
void addOdometryGraphs(Store& store, const std::vector<SessionId>& ids, StoredResults& results) {
  for (std::size_t s = 0; s < ids.size(); ++s) {
    const urban_nav_store::StoredTrajectory trajectory = readTrajectory(store, *store.sessions().find(ids[s]));
    if (trajectory.relaxed)
      results.left_out.push_back("graph.g2o: " + trajectory.session.name +
                                 " was relaxed with sessions of another store");
    else results.files.push_back({"graph" + fileSuffix(s) + ".g2o", exportG2o(store, {{trajectory}}).text});
  }
}

}  // namespace

StoredResults readResults(Store& store) {
  const PreviousSessions sessions = readPreviousSessions(store, {});
  if (sessions.ids.empty()) throw urban_nav_core::DataError(store.path(), "has no session with poses", "");
  StoredResults results;
  std::vector<const SessionOdometry*> runs;
  for (const SessionOdometry& run : sessions.runs) runs.push_back(&run);
  const std::vector<SessionTrajectory> trajectories = storedTrajectories(store, sessions, results.left_out);
  for (const OutputFile& file : trajectoryFiles(runs, trajectories))
    if (file.content) results.files.push_back({file.name, file.content()});
  results.files.push_back({"closures.csv", readStoredClosures(store)});
  const auto graph = urban_nav_store::TableStore<urban_nav_store::StoredGraph>(store).get({sessions.ids.front(), {}});
  const std::optional<std::string> text = graph ? urban_nav_store::inflated(graph->file, kMostGraph) : std::nullopt;
  if (text) results.files.push_back({"graph.g2o", *text});
  else addOdometryGraphs(store, sessions.ids, results);
  return results;
}

std::map<SessionId, std::string> sessionNamesById(Store& store) {
  const PreviousSessions sessions = readPreviousSessions(store, {});
  std::map<SessionId, std::string> names;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) names[sessions.ids[s]] = sessions.names[s];
  return names;
}

std::size_t numberOfSession(Store& store, const SessionId& id) {
  const std::vector<SessionId> ids = readPreviousSessions(store, {}).ids;
  return static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
}

}  // namespace urban_nav
