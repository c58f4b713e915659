// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/store_info.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <numeric>

#include "base/plot.hpp"
#include "map/store_keys.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_store/stored_ids.hpp"
#include "urban_nav_store/stored_map.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_keyframe_place.hpp"

namespace urban_nav {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::StampNs;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::Store;
using urban_nav_store::StoredPlace;
using urban_nav_store::StoredTrajectory;

namespace {

double computeLength(const std::vector<urban_nav_core::StampedPose>& poses) {
  double length = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) length += distanceBetween(poses[i - 1].pose, poses[i].pose);
  return length;
}

std::vector<urban_nav_input::StreamInfo> listStreams(Store& store, const urban_nav_store::SessionId& id) {
  std::map<std::string, urban_nav_input::StreamInfo> streams;
  std::map<std::string, std::int64_t> unused;
  store.inputs().forEach(id, [&](const urban_nav_store::InputEvent& event) {
    urban_nav_input::StreamInfo& stream = streams[event.stream];
    stream.name = event.stream;
    if (stream.messages++ == 0) stream.first = stream.last = event.stamp;
    if (stream.messages > 1 && event.stamp <= stream.last) ++stream.backward;
    stream.longest_gap_s = std::max(stream.longest_gap_s, urban_nav_core::secondsBetween(stream.last, event.stamp));
    stream.last = std::max(stream.last, event.stamp);
    if (!event.used) ++unused[event.stream];
  });
  std::vector<urban_nav_input::StreamInfo> result;
  for (auto& [name, stream] : streams) {
    const double seconds = urban_nav_core::secondsBetween(stream.first, stream.last);
    stream.rate_hz = seconds > 0.0 ? static_cast<double>(stream.messages - 1) / seconds : 0.0;
    if (unused[name] > 0) stream.type = std::to_string(unused[name]) + " not used";
    result.push_back(stream);
  }
  return result;
}

/// Groups of sessions joined by accepted closures, as disjoint sets.
class Groups {
 public:
  explicit Groups(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) { return parent_[i] == i ? i : parent_[i] = find(parent_[i]); }
  void join(std::size_t a, std::size_t b) { parent_[std::max(find(a), find(b))] = std::min(find(a), find(b)); }

 private:
  std::vector<std::size_t> parent_;
};

std::string toId(const std::vector<StoredSession>& sessions, std::size_t i) {
  return sessions[i].session.id.substr(0, 8);
}

/// "31.4 kB", "14.2 MB".
std::string printBytes(std::int64_t bytes) {
  const auto value = static_cast<double>(bytes);
  return bytes < 1'000'000 ? urban_nav_core::formatNumber(value / 1e3, 3) + " kB"
                           : urban_nav_core::formatNumber(value / 1e6, 3) + " MB";
}

std::string toText(const StoredSession& each) {
  const double seconds = urban_nav_core::secondsBetween(each.first, each.last);
  std::string text = "\n  session " + each.session.id + "  " + each.session.name +
                     (each.session.complete ? "" : "  (not complete)") + "\n";
  if (!each.session.robot.empty()) text += "    robot " + each.session.robot + "\n";
  if (each.nodes > 0) {
    text += "    " + urban_nav_core::printStamp(each.first) + " ... " + urban_nav_core::printStamp(each.last) +
            " s: " + urban_nav_core::formatNumber(seconds, 4) + " s, " +
            urban_nav_core::formatNumber(each.length_m, 4) + " m" + (each.relaxed ? "" : " (by odometry)") +
            "\n    nodes " + std::to_string(each.nodes) +
            (seconds > 0.0
                 ? ", " + urban_nav_core::formatNumber(static_cast<double>(each.nodes - 1) / seconds, 3) + " per second"
                 : "");
    for (const auto& [status, count] : each.status_counts)
      if (status != "OK") text += ", " + std::to_string(count) + " " + status;
    text += "\n";
  }
  for (const auto& [kind, verdicts] : each.edges) {
    text += "    edges " + kind + ":";
    std::string counts;
    for (const auto& [verdict, count] : verdicts)
      counts += (counts.empty() ? " " : ", ") + std::to_string(count) + " " + verdict;
    text += counts + "\n";
  }
  for (const urban_nav_input::StreamInfo& stream : each.streams)
    text += "    stream " + stream.name + ": " + std::to_string(stream.messages) + " at " +
            urban_nav_core::formatNumber(stream.rate_hz, 4) + " Hz, longest gap " +
            urban_nav_core::formatNumber(stream.longest_gap_s, 3) + " s" +
            (stream.type.empty() ? "" : ", " + stream.type) + "\n";
  for (const auto& [model, places] : each.places)
    text += "    places: " + std::to_string(places) + ", words of model " + model + "\n";
  for (const auto& [model, places] : each.keyframe_places)
    text += "    keyframes for localization: " + std::to_string(places) + ", words of model " + model + "\n";
  for (const auto& [laser, scans] : each.scans) text += "    scans of " + laser + ": " + std::to_string(scans) + "\n";
  if (!each.frames.empty()) {
    text += "    frames base_link";
    for (const std::string& frame : each.frames) text += ", " + frame;
    text += "\n";
  }
  if (each.resumable) text += "    an interrupted run of map can continue from here\n";
  if (each.next_bag)
    text += "    state at the end of its last bag, " + printBytes(each.state_bytes) +
            ": the next bag can continue from here\n";
  return text;
}

}  // namespace

StoreInfo readStoreInfo(const std::string& path) {
  Store store = urban_nav_store::openForReading(path, urban_nav_store::Access::Frozen);
  StoreInfo info;
  info.path = path;
  if (urban_nav_store::isRelease(path)) info.release = readReleaseHead(store);
  for (const char* suffix : {"", "-wal"}) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path + suffix, error);
    if (!error) info.bytes += static_cast<std::int64_t>(size);
  }
  std::map<std::string, std::size_t> places;
  for (const urban_nav_store::Session& session : store.sessions().all()) {
    places[session.id] = info.sessions.size();
    StoredSession& each = info.sessions.emplace_back();
    each.session = session;
    const StoredTrajectory trajectory = readTrajectory(store, session);
    each.map = trajectory.map;
    each.relaxed = trajectory.relaxed;
    each.nodes = static_cast<std::int64_t>(trajectory.T_map_base.size());
    if (each.nodes > 0) {
      each.first = trajectory.T_map_base.front().stamp;
      each.last = trajectory.T_map_base.back().stamp;
    }
    each.length_m = computeLength(trajectory.T_map_base);
    store.graph().forEachNode(session.id,
                              [&](const urban_nav_store::Node& node) { ++each.status_counts[toString(node.status)]; });
    each.streams = listStreams(store, session.id);
    for (const std::string& laser : store.scans().lasers(session.id))
      each.scans[laser] = store.scans().count(session.id, laser);
    urban_nav_store::TableStore<StoredPlace>(store).forEach(session.id,
                                                            [&](const StoredPlace& row) { ++each.places[row.model]; });
    urban_nav_store::TableStore<urban_nav_store::StoredKeyframePlace>(store).forEach(
        session.id, [&](const StoredPlace& row) { ++each.keyframe_places[row.model]; });
    for (const urban_nav_store::Extrinsic& extrinsic : store.sessions().extrinsics(session.id))
      each.frames.push_back(extrinsic.frame);
    const std::vector<std::string> stages = store.states().stages(session.id);
    each.resumable = std::find(stages.begin(), stages.end(), kVoStage) != stages.end() ||
                     std::find(stages.begin(), stages.end(), kLoStage) != stages.end();
    each.next_bag = std::find(stages.begin(), stages.end(), kBagStage) != stages.end();
    each.state_bytes = store.states().bytes(session.id);
  }
  Groups groups(info.sessions.size());
  for (StoredSession& each : info.sessions) {
    store.graph().forEachEdge(each.session.id, [&](const Edge& edge) {
      ++each.edges[toString(edge.kind)][toString(edge.verdict)];
      const auto b = places.find(edge.b.session);
      if (edge.verdict == ClosureVerdict::Accepted && edge.kind != EdgeKind::Session && b != places.end())
        groups.join(places.at(edge.a.session), b->second);
    });
  }
  for (std::size_t i = 0; info.release && i < info.sessions.size(); ++i)  // its closures may be left out
    for (std::size_t k = 0; k < i; ++k)
      if (info.sessions[i].map == info.sessions[k].map) groups.join(i, k);
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < info.sessions.size(); ++i) members[groups.find(i)].push_back(i);
  for (auto& [first, group] : members) info.joined.push_back(std::move(group));
  return info;
}

std::string toText(const StoreInfo& info) {
  std::string text = info.path +
                     (info.release ? ": release " + std::to_string(info.release->version) + ", digest " +
                                         info.release->digest.substr(0, 12) + ", "
                                   : std::string(": session store, ")) +
                     printBytes(info.bytes) + ", " + std::to_string(info.sessions.size()) +
                     (info.sessions.size() == 1 ? " session\n" : " sessions\n");
  for (const StoredSession& each : info.sessions) text += toText(each);
  text += info.sessions.empty() ? "" : "\n";
  for (std::size_t i = 0; i < info.joined.size(); ++i) {
    text += "  map " + std::to_string(i + 1) + ":";
    for (const std::size_t member : info.joined[i]) text += " " + toId(info.sessions, member);
    const StoredSession& first = info.sessions[info.joined[i].front()];
    const bool anchored = std::any_of(info.sessions.begin(), info.sessions.end(),
                                      [&](const StoredSession& each) { return each.session.id == first.map; });
    text += (info.joined[i].size() > 1 ? ", joined by closures" : "") + std::string("; origin at the first pose of ") +
            (anchored ? first.map : first.session.id).substr(0, 8) + "\n";
  }
  return text;
}

namespace {

void addRelease(const urban_nav_store::ReleaseHead& release, Json& json) {
  json["version"] = release.version;
  json["digest"] = release.digest;
  Json& parents = json["parents"] = Json::array();
  for (const std::string& parent : release.parents) parents.append(parent);
}

}  // namespace

Json toJson(const StoreInfo& info) {
  Json json = Json::object();
  json["name"] = info.path;
  json["kind"] = info.release ? "release" : "session store";
  json["bytes"] = info.bytes;
  if (info.release) addRelease(*info.release, json);
  Json& sessions = json["sessions"] = Json::array();
  for (const StoredSession& each : info.sessions) {
    Json entry = Json::object();
    entry["id"] = each.session.id;
    entry["name"] = each.session.name;
    entry["robot"] = each.session.robot;
    entry["complete"] = each.session.complete;
    entry["start_ns"] = each.session.start;
    entry["first_ns"] = each.first;
    entry["last_ns"] = each.last;
    entry["duration_s"] = urban_nav_core::secondsBetween(each.first, each.last);
    entry["distance_m"] = each.length_m;
    entry["relaxed"] = each.relaxed;
    entry["nodes"] = each.nodes;
    Json& status = entry["status_counts"] = Json::object();
    for (const auto& [name, count] : each.status_counts) status[name] = count;
    Json& edges = entry["edges"] = Json::object();
    for (const auto& [kind, verdicts] : each.edges)
      for (const auto& [verdict, count] : verdicts) edges[kind][verdict] = count;
    Json& streams = entry["streams"] = Json::array();
    for (const urban_nav_input::StreamInfo& stream : each.streams) {
      Json of_stream = Json::object();
      of_stream["name"] = stream.name;
      of_stream["messages"] = stream.messages;
      of_stream["rate_hz"] = stream.rate_hz;
      of_stream["longest_gap_s"] = stream.longest_gap_s;
      streams.append(of_stream);
    }
    Json& scans = entry["scans"] = Json::object();
    for (const auto& [laser, count] : each.scans) scans[laser] = count;
    Json& of_places = entry["places"] = Json::object();
    for (const auto& [model, count] : each.places) of_places[model] = count;
    Json& of_keyframes = entry["keyframe_places"] = Json::object();
    for (const auto& [model, count] : each.keyframe_places) of_keyframes[model] = count;
    Json& frames = entry["frames"] = Json::array();
    for (const std::string& frame : each.frames) frames.append(frame);
    entry["map"] = each.map;
    entry["resumable"] = each.resumable;
    entry["next_bag"] = each.next_bag;
    entry["state_bytes"] = each.state_bytes;
    sessions.append(entry);
  }
  Json& maps = json["maps"] = Json::array();
  for (const std::vector<std::size_t>& group : info.joined) {
    Json members = Json::array();
    for (const std::size_t member : group) members.append(info.sessions[member].session.id);
    maps.append(members);
  }
  return json;
}

}  // namespace urban_nav
