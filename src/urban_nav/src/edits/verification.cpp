// SPDX-License-Identifier: BSD-3-Clause
#include "edits/verification.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "edits/edited_map.hpp"
#include "map/map_base.hpp"
#include "pose_graph/stored_edits.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_store/dump.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKey;
using urban_nav_store::EdgeKind;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

constexpr StampNs kMinute = 60'000'000'000;
constexpr StampNs kVerifiedSecond = 1'000'000'000;

/// Names and start times of the sessions of a store.
class SessionClock {
 public:
  explicit SessionClock(const PreviousSessions& sessions) {
    for (std::size_t s = 0; s < sessions.ids.size(); ++s) {
      name_[sessions.ids[s]] = sessions.names[s];
      begin_[sessions.ids[s]] = sessions.runs[s].settled.front().stamp;
    }
  }
  std::string name(const SessionId& id) const {
    const auto found = name_.find(id);
    return found == name_.end() ? id : found->second;
  }
  std::int64_t minute(const SessionId& id, StampNs stamp) const {
    const auto found = begin_.find(id);
    return found == begin_.end() ? 0 : std::max<StampNs>(0, stamp - found->second) / kMinute;
  }

 private:
  std::map<SessionId, std::string> name_;
  std::map<SessionId, StampNs> begin_;
};

std::string countText(std::size_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

void comparePosesByMinute(const SessionClock& clock, const SessionId& id, const urban_nav_core::Trajectory& stored,
                          const urban_nav_core::Trajectory& relaxed, std::vector<Difference>& differences) {
  if (stored.size() != relaxed.size()) {
    differences.push_back(
        {"graph", clock.name(id), 0,
         std::to_string(stored.size()) + " poses in the store, " + std::to_string(relaxed.size()) + " by relaxation"});
    return;
  }
  std::map<std::int64_t, std::pair<std::size_t, double>> by_minute;  // number of poses, and the largest distance
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const urban_nav_core::Pose &a = stored[i].pose, &b = relaxed[i].pose;
    if (stored[i].stamp == relaxed[i].stamp && a.t() == b.t() && a.q().coeffs() == b.q().coeffs()) continue;
    auto& [poses, largest] = by_minute[clock.minute(id, stored[i].stamp)];
    ++poses;
    largest = std::max(largest, (a.t() - b.t()).norm());
  }
  for (const auto& [minute, found] : by_minute)
    differences.push_back({"graph", clock.name(id), minute,
                           countText(found.first, "pose") + " relaxed to another position, by up to " +
                               urban_nav_core::formatNumber(1e3 * found.second, 3) + " mm"});
}

/// Returns the stage that writes each table of a store.
const std::map<std::string, std::string>& stagesOfTables() {
  static const std::map<std::string, std::string> stages = {{"input", "input"},
                                                            {"node", "vo"},
                                                            {"extrinsic", "input"},
                                                            {"keyframe", "keyframes"},
                                                            {"panorama", "places"},
                                                            {"place", "places"},
                                                            {"keyframe_place", "places"},
                                                            {"ground_view", "stereo"},
                                                            {"near_points", "stereo"},
                                                            {"depth_view", "stereo"},
                                                            {"scan", "lasers"},
                                                            {"mounted_lidar", "lasers"},
                                                            {"lidar_sweep", "lasers"},
                                                            {"depth_image", "lasers"},
                                                            {"fix", "graph"},
                                                            {"chunk", "lasers"},
                                                            {"chunk_cells", "lasers"}};
  return stages;
}

/// A row printed by dump(): table, session and time; the rest is compared as text.
struct DumpedRow {
  std::string table;
  SessionId session;
  StampNs stamp = 0;  ///< 0: without one
};

DumpedRow parseRow(const std::string& line) {
  DumpedRow row;
  const std::vector<std::string_view> words = urban_nav_core::splitBlanks(line);
  if (words.size() < 2) return row;
  row.table = words[0];
  row.session = words[1].size() > 2 ? words[1].substr(1, words[1].size() - 2) : "";
  for (std::size_t i = 2; i < std::min<std::size_t>(words.size(), 5); ++i)
    if (const auto number = urban_nav_core::parseInteger(words[i])) {
      row.stamp = row.table == "scan" ? *number * kVerifiedSecond : row.table == "input" ? 0 : *number;
      break;
    }
  return row;
}

/// Returns the unique lines of a dump.
std::set<std::string> dumpedRows(Store& store, bool with_map) {
  std::set<std::string> rows;
  const std::string text = urban_nav_store::dump(store);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    const std::string table = line.substr(0, line.find(' '));
    const bool is_map = table == "chunk" || table == "chunk_cells";
    if (stagesOfTables().count(table) > 0 && (with_map || !is_map)) rows.insert(std::move(line));
  }
  return rows;
}

/// Returns the key of an edge without the line of its file, which may differ.
EdgeKey withoutFile(EdgeKey key) {
  std::string& source = std::get<5>(key);
  const std::size_t colon = source.rfind(':');
  if (colon != std::string::npos && urban_nav_core::parseInteger(source.substr(colon + 1))) source.clear();
  return key;
}

std::map<EdgeKey, urban_nav_core::Constraint> measuredEdges(Store& store) {
  std::map<EdgeKey, urban_nav_core::Constraint> edges;
  for (const urban_nav_store::Session& session : store.sessions().all())
    store.graph().forEachEdge(session.id, [&](const Edge& edge) {
      if (edge.kind != EdgeKind::Plane && !urban_nav_store::isOfEdit(edge.source))
        edges[withoutFile(edgeKey(edge))] = edge.measured;
    });
  return edges;
}

bool isSame(const urban_nav_core::Constraint& a, const urban_nav_core::Constraint& b) {
  return a.T_a_b.t() == b.T_a_b.t() && a.T_a_b.q().coeffs() == b.T_a_b.q().coeffs() && a.information == b.information;
}

}  // namespace

std::vector<Difference> compareRelaxation(Store& store, Store& measured) {
  const StoredMeasurements measurements = readMeasurements(measured);
  const PreviousSessions& sessions = measurements.sessions;
  const SessionClock clock(sessions);
  const GraphRun run = relaxEdited(measurements, pose_graph::readEdits(store, sessions.ids, sessions.names));
  std::vector<Difference> differences;
  const MapPoses stored = storedPoses(store, sessions.ids), relaxed = relaxedPoses(run);
  for (std::size_t s = 0; s < stored.size(); ++s)
    if (!relaxed[s].empty()) comparePosesByMinute(clock, sessions.ids[s], stored[s], relaxed[s], differences);
  std::map<EdgeKey, Edge> edges;
  for (const SessionId& id : sessions.ids)
    store.graph().forEachEdge(id, [&](const Edge& edge) { edges[withoutFile(edgeKey(edge))] = edge; });
  std::map<std::string, SessionId> id;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) id[sessions.names[s]] = sessions.ids[s];
  const auto compare = [&](const pose_graph::Closure& closure) {
    const SessionId &a = id.at(closure.a.session), &b = id.at(closure.b.session);
    const auto found = edges.find(withoutFile({a, closure.a.stamp, b, closure.b.stamp, closure.kind, closure.source}));
    const std::string known = found == edges.end() ? "absent" : toString(found->second.verdict);
    if (known != toString(closure.verdict))
      differences.push_back({"graph", clock.name(b), clock.minute(b, closure.b.stamp),
                             "a closure by " + std::string(toString(closure.kind)) + " is " + known +
                                 " in the store, and " + toString(closure.verdict) + " by relaxation"});
  };
  for (const auto& [number, closure] : run.graph.closures()) compare(closure);
  for (const pose_graph::Closure& closure : run.rejected_by_hand) compare(closure);
  return differences;
}

std::vector<Difference> compareMeasurements(Store& store, Store& again) {
  const SessionClock clock(readPreviousSessions(store, {}));
  const bool was_edited = !urban_nav_store::EditJournal(store).all().empty();
  const std::set<std::string> stored = dumpedRows(store, !was_edited), relaxed = dumpedRows(again, !was_edited);
  std::map<std::tuple<std::string, std::string, std::int64_t>, std::map<std::string, std::size_t>> rows;
  const auto count = [&](const std::set<std::string>& some, const std::set<std::string>& others) {
    for (const std::string& line : some) {
      if (others.count(line) > 0) continue;
      const DumpedRow row = parseRow(line);
      if (!again.sessions().find(row.session)) continue;  // its recording was not given
      ++rows[{stagesOfTables().at(row.table), clock.name(row.session), clock.minute(row.session, row.stamp)}]
            [row.table];
    }
  };
  count(stored, relaxed);
  count(relaxed, stored);
  std::vector<Difference> differences;
  for (const auto& [place, tables] : rows) {
    std::string text;
    for (const auto& [table, number] : tables)
      text += (text.empty() ? "" : ", ") + countText(number, "row") + " of " + table;
    differences.push_back({std::get<0>(place), std::get<1>(place), std::get<2>(place), text + " differ"});
  }
  const std::map<EdgeKey, urban_nav_core::Constraint> before = measuredEdges(store), after = measuredEdges(again);
  std::map<std::tuple<std::string, std::string, std::int64_t>, std::size_t> edges;
  const auto put = [&](const EdgeKey& key) {
    const SessionId& b = std::get<2>(key);
    if (!again.sessions().find(b) || !again.sessions().find(std::get<0>(key))) return;
    const std::string stage = std::get<EdgeKind>(key) == EdgeKind::Odometry ? "vo" : "loops";
    ++edges[{stage, clock.name(b), clock.minute(b, std::get<3>(key))}];
  };
  for (const auto& [key, measured] : before) {
    const auto other = after.find(key);
    if (other == after.end() || !isSame(measured, other->second)) put(key);
  }
  for (const auto& [key, measured] : after)
    if (before.count(key) == 0) put(key);
  for (const auto& [place, number] : edges)
    differences.push_back(
        {std::get<0>(place), std::get<1>(place), std::get<2>(place),
         countText(number, std::get<0>(place) == "vo" ? "step" : "closure") + " measured differently"});
  return differences;
}

}  // namespace urban_nav
