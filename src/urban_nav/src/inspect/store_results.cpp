// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/store_results.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "inspect/store_export.hpp"
#include "loop_metric/evidence.hpp"
#include "map/closure_rows.hpp"
#include "map/previous_sessions.hpp"
#include "map/stage_result.hpp"
#include "map/trajectory_files.hpp"
#include "urban_nav_core/io/closures_csv.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/deflate.hpp"
#include "urban_nav_store/stored_map.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_graph.hpp"

namespace urban_nav {

using urban_nav_core::ClosureRow;
using urban_nav_core::Matrix6d;
using urban_nav_core::StampNs;
using urban_nav_store::Edge;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr std::size_t kMostGraph = std::size_t{1} << 32;  // bytes of graph.g2o

/// Returns whether a store has no covariances of a session: those of all its poses are zero.
bool isUnknown(const std::vector<Matrix6d>& covariances) {
  return covariances.size() > 1 && std::all_of(covariances.begin(), covariances.end(),
                                               [](const Matrix6d& covariance) { return covariance.isZero(0.0); });
}

/// Poses and covariances of stored sessions, as the stages of `map` hand them to the writer of their files.
std::vector<SessionTrajectory> storedTrajectories(Store& store, const PreviousSessions& sessions,
                                                  std::vector<std::string>& left_out) {
  std::vector<SessionTrajectory> trajectories;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) {
    const urban_nav_store::Session session = *store.sessions().find(sessions.ids[s]);
    const urban_nav_store::StoredTrajectory stored = readTrajectory(store, session);
    std::map<StampNs, Matrix6d> covariances;
    store.graph().forEachRelaxed(session.id, [&](const urban_nav_store::RelaxedPose& pose) {
      covariances.emplace_hint(covariances.end(), pose.stamp, pose.covariance);
    });
    SessionTrajectory trajectory;
    trajectory.map = static_cast<std::size_t>(std::find(sessions.ids.begin(), sessions.ids.end(), stored.map) -
                                              sessions.ids.begin());
    if (trajectory.map == sessions.ids.size()) trajectory.map = s;
    trajectory.written = true;
    for (std::size_t i = 0; i < stored.T_map_base.size(); ++i) {
      const urban_nav_core::StampedPose& pose = stored.T_map_base[i];
      trajectory.T_map_base.append(pose.stamp, pose.pose);
      const auto relaxed = covariances.find(pose.stamp);
      trajectory.covariances.push_back(
          relaxed != covariances.end() ? relaxed->second : sessions.runs[s].settled[i].T_odom_base.covariance);
    }
    if (isUnknown(trajectory.covariances)) {
      trajectory.covariances.clear();
      left_out.push_back("rows of session " + sessions.names[s] +
                         " in covariance.csv: the store was written live, or by an earlier version, and holds none");
    }
    trajectories.push_back(std::move(trajectory));
  }
  return trajectories;
}

/// A row of closures.csv and its place there.
struct PlacedRow {
  ClosurePlace place;
  std::vector<std::string> cells;
};

/// Returns the row of closures.csv with which an edge was stored, its cells to the last digit; nullopt for edges of
/// other stages. `a`, `b`: names of its sessions.
std::optional<PlacedRow> storedRow(const std::string& evidence, const std::string& a, const std::string& b,
                                   const std::vector<std::string>& names) {
  const std::string_view text = evidence;
  const std::string_view row = text.substr(0, text.size() - loop_metric::evidenceIn(text).size());
  try {
    const urban_nav_core::CsvTable table = urban_nav_core::CsvTable::parse(row, "evidence");
    const std::vector<ClosureRow> parsed = urban_nav_core::parseClosures(row, "evidence");
    if (parsed.size() != 1) return std::nullopt;
    PlacedRow placed;
    for (std::size_t column = 0; column < table.header().size(); ++column)
      placed.cells.push_back(table.text(0, column));
    placed.cells.at(table.column("session_a")) = a;
    placed.cells.at(table.column("session_b")) = b;
    placed.place = closurePlace(names, {a, parsed.front().a.stamp}, {b, parsed.front().b.stamp}, parsed.front().method);
    return placed;
  } catch (const urban_nav_core::UserError&) {
    return std::nullopt;  // the evidence of another stage
  }
}

std::map<SessionId, std::string> namesById(const PreviousSessions& sessions) {
  std::map<SessionId, std::string> names;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) names[sessions.ids[s]] = sessions.names[s];
  return names;
}

std::string closuresCsv(Store& store, const PreviousSessions& sessions) {
  const std::map<SessionId, std::string> names = namesById(sessions);
  std::vector<PlacedRow> rows;
  for (const SessionId& id : sessions.ids) {
    std::vector<Edge> edges;
    store.graph().forEachEdge(id, [&](const Edge& edge) {
      if (edge.kind != urban_nav_store::EdgeKind::Odometry && names.count(edge.b.session) != 0) edges.push_back(edge);
    });
    for (const Edge& edge : edges) {
      const std::optional<std::string> evidence = store.graph().evidence(edge);
      if (!evidence) continue;
      auto row = storedRow(*evidence, names.at(edge.a.session), names.at(edge.b.session), sessions.names);
      if (row) rows.push_back(std::move(*row));
    }
  }
  std::stable_sort(rows.begin(), rows.end(), [](const PlacedRow& a, const PlacedRow& b) { return a.place < b.place; });
  std::string text = urban_nav_core::printClosures({});
  for (const PlacedRow& row : rows) text += urban_nav_core::printCsvRow(row.cells);
  return text;
}

/// Adds the graphs of sessions that nothing has relaxed: odometry alone, each in a file of its own.
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
  if (sessions.ids.empty()) throw urban_nav_core::DataError(store.path(), "holds no session with poses", "");
  StoredResults results;
  std::vector<const SessionOdometry*> runs;
  for (const SessionOdometry& run : sessions.runs) runs.push_back(&run);
  const std::vector<SessionTrajectory> trajectories = storedTrajectories(store, sessions, results.left_out);
  for (const OutputFile& file : trajectoryFiles(runs, trajectories))
    if (file.content) results.files.push_back({file.name, file.content()});
  results.files.push_back({"closures.csv", closuresCsv(store, sessions)});
  const auto graph = urban_nav_store::TableStore<urban_nav_store::StoredGraph>(store).get({sessions.ids.front(), {}});
  const std::optional<std::string> text = graph ? urban_nav_store::inflated(graph->file, kMostGraph) : std::nullopt;
  if (text) results.files.push_back({"graph.g2o", *text});
  else addOdometryGraphs(store, sessions.ids, results);
  return results;
}

std::string storedClosures(Store& store) { return closuresCsv(store, readPreviousSessions(store, {})); }

std::map<SessionId, std::string> sessionNamesById(Store& store) { return namesById(readPreviousSessions(store, {})); }

std::size_t numberOfSession(Store& store, const SessionId& id) {
  const std::vector<SessionId> ids = readPreviousSessions(store, {}).ids;
  return static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
}

}  // namespace urban_nav
