// SPDX-License-Identifier: BSD-3-Clause
#include "join/release_selection.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "fabmap_node/recognition/compact_look.hpp"
#include "fabmap_node/recognition/second_look.hpp"
#include "laser_mapper/chunk_renderer.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_keyframe_place.hpp"

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;
using urban_nav_store::SessionId;
using urban_nav_store::Store;
using urban_nav_store::StoredKeyframePlace;
using urban_nav_store::StoredPlace;
using urban_nav_store::StoredTrajectory;

namespace {

constexpr double kGroundCell = 3.0;        // m, at least the distances below
constexpr double kKeptViewDistance = 1.0;  // m, and
constexpr double kKeptViewAngle = 0.35;    // rad: 92 to 100 of 100 keyframes within these limits match
constexpr double kOwnViewDistance = 0.5;   // m
constexpr double kPlaceDistance = 2.0;     // m: panoramas, whatever the heading
constexpr double kOwnPlaceDistance = 0.4;  // m
constexpr double kAnyAngle = 4.0;          // rad: no limit
constexpr double kSameFeatures = 0.5;      // share of matching features above which a view adds nothing
constexpr std::size_t kAppearances = 3;    // sessions with views of the same place and heading
constexpr double kCloudDistance = 5.0;     // m between the centres of clouds, as in CloudSearch
constexpr StampNs kAround = 500'000'000;   // ns of poses around a view, from which those of panoramas are interpolated

std::pair<int, int> groundCell(const Vector3d& p) {
  return {static_cast<int>(std::floor(p.x() / kGroundCell)), static_cast<int>(std::floor(p.y() / kGroundCell))};
}

/// Calls `visit` with the elements of the cells around a point until it returns false.
template <typename Element, typename Visit>
void forEachAround(const std::map<std::pair<int, int>, std::vector<Element>>& cells, const Vector3d& p, int reach,
                   const Visit& visit) {
  const auto [x, y] = groundCell(p);
  for (int dx = -reach; dx <= reach; ++dx)
    for (int dy = -reach; dy <= reach; ++dy) {
      const auto cell = cells.find({x + dx, y + dy});
      if (cell == cells.end()) continue;
      for (const Element& element : cell->second)
        if (!visit(element)) return;
    }
}

double agreement(const std::string& one, const std::string& other) {
  if (one.empty() || other.empty()) return 0.0;
  return fabmap_node::secondLook(fabmap_node::unpackLook(one, "view"), fabmap_node::unpackLook(other, "view")).share;
}

/// Appends an interval, merged with the last one if they touch.
void append(KeptSession::Interval interval, std::vector<KeptSession::Interval>& intervals) {
  if (!intervals.empty() && interval.first <= intervals.back().second)
    intervals.back().second = std::max(intervals.back().second, interval.second);
  else intervals.push_back(interval);
}

bool isWithin(const std::vector<KeptSession::Interval>& intervals, StampNs from, StampNs to) {
  return std::any_of(intervals.begin(), intervals.end(), [&](const KeptSession::Interval& interval) {
    return from <= interval.second && to >= interval.first;
  });
}

/// Returns whether a store has scans of a session around a time.
bool holdsScans(Store& store, const SessionId& id, StampNs stamp) {
  bool any = false;
  for (const std::string& laser : store.scans().lasers(id))
    store.scans().forEach(id, laser, stamp - kAround, stamp + kAround,
                          [&](const urban_nav_core::Scan&) { any = true; });
  return any;
}

bool isNearAny(const std::set<StampNs>& stamps, StampNs stamp) {
  const auto after = stamps.lower_bound(stamp - kAround);
  return after != stamps.end() && *after <= stamp + kAround;
}

}  // namespace

void ReleaseSelection::Views::keep(const View& view) { cells_[groundCell(view.T_map_base.t())].push_back(view); }

bool ReleaseSelection::Views::add(const View& view, const Nearness& nearness) {
  std::set<std::size_t> near;  // other sessions
  bool is_known = false;
  forEachAround(cells_, view.T_map_base.t(), 1, [&](const View& other) {
    const double distance = distanceBetween(view.T_map_base, other.T_map_base);
    if (distance > nearness.distance || angleBetween(view.T_map_base, other.T_map_base) > nearness.angle) return true;
    if (other.session == view.session) {
      is_known = distance < nearness.own_distance && agreement(view.features, other.features) >= kSameFeatures;
    } else {
      near.insert(other.session);
      is_known = near.size() >= kAppearances || agreement(view.features, other.features) >= kSameFeatures;
    }
    return !is_known;
  });
  if (!is_known) keep(view);
  return !is_known;
}

void ReleaseSelection::selectViews(Store& store, const StoredTrajectory& session, KeptSession& kept) {
  const SessionId& id = session.session.id;
  std::map<StampNs, Pose> poses;
  for (const urban_nav_core::StampedPose& pose : session.T_map_base) poses[pose.stamp] = pose.pose;
  const urban_nav_core::Trajectory trajectory(session.T_map_base);
  urban_nav_store::TableStore<StoredKeyframePlace> described(store);
  for (const StampNs stamp : store.keyframes().stamps(id, urban_nav_registration::kKeyframeCamera)) {
    const auto pose = poses.find(stamp);
    if (pose == poses.end()) continue;
    StoredKeyframePlace key;
    key.session = id;
    key.stamp = stamp;
    const auto row = described.get(key);
    const View view{sessions_, pose->second, row ? row->descriptors : std::string()};
    if (kept.is_whole) keyframes_.keep(view);
    if (kept.is_whole || keyframes_.add(view, {kKeptViewDistance, kKeptViewAngle, kOwnViewDistance}))
      kept.keyframes.insert(stamp);
  }
  urban_nav_store::TableStore<StoredPlace>(store).forEach(id, [&](const StoredPlace& row) {
    const auto pose = trajectory.empty() ? std::nullopt : trajectory.at(row.stamp, kAround);
    if (!pose || row.status != "used") return;
    const View view{sessions_, *pose, row.descriptors};
    const double angle = row.cameras > 1 ? kAnyAngle : kKeptViewAngle;
    if (kept.is_whole) places_.keep(view);
    if (kept.is_whole || places_.add(view, {kPlaceDistance, angle, kOwnPlaceDistance})) kept.places.insert(row.stamp);
  });
}

void ReleaseSelection::selectStretches(Store& store, const StoredTrajectory& session, KeptSession& kept) {
  if (store.scans().lasers(session.session.id).empty() || session.T_map_base.empty()) return;
  const std::vector<urban_nav_core::StampedPose>& poses = session.T_map_base;
  std::vector<double> driven(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i)
    driven[i] = driven[i - 1] + distanceBetween(poses[i - 1].pose, poses[i].pose);
  double due = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (driven[i] < due && i + 1 < poses.size()) continue;
    due = driven[i] + kCloudDistance;
    const Vector3d p = poses[i].pose.t();
    bool is_known = false;
    if (kept.is_whole) is_known = !holdsScans(store, session.session.id, poses[i].stamp);
    else
      forEachAround(clouds_, p, 2, [&](const Vector3d& other) {
        is_known = (p - other).norm() <= kCloudDistance;
        return !is_known;
      });
    if (is_known) continue;
    clouds_[groundCell(p)].push_back(p);
    const auto from = std::lower_bound(driven.begin(), driven.end(), driven[i] - cloud_half_length_);
    const auto to = std::upper_bound(driven.begin(), driven.end(), driven[i] + cloud_half_length_);
    append({poses[static_cast<std::size_t>(from - driven.begin())].stamp,
            poses[static_cast<std::size_t>(to - driven.begin()) - 1].stamp},
           kept.stretches);
  }
}

KeptSession ReleaseSelection::select(Store& store, const StoredTrajectory& session, bool is_whole) {
  KeptSession kept;
  kept.id = session.session.id;
  kept.is_whole = is_whole;
  selectViews(store, session, kept);
  selectStretches(store, session, kept);
  ++sessions_;
  return kept;
}

KeptSession ReleaseSelection::add(Store& store, const StoredTrajectory& session) {
  return select(store, session, false);
}

KeptSession ReleaseSelection::addWhole(Store& store, const StoredTrajectory& session) {
  return select(store, session, true);
}

namespace {

constexpr StampNs kSecond = 1'000'000'000;

/// Tables omitted from a release: data needed only for a later relaxation, another run on the same recording or the
/// colours of the map, and tiles, which refer to poses that a release does not keep.
const std::set<std::string>& leftOutTables() {
  static const std::set<std::string> names = {"panorama",   "camera",      "input", "parameter", "evidence",
                                              "graph_file", "edge_number", "edit",  "tile"};
  return names;
}

/// Selects the rows of one table.
class RowSelection {
 public:
  RowSelection(const std::vector<KeptSession>& sessions, SessionId first) : first_(std::move(first)) {
    for (const KeptSession& session : sessions) kept_[session.id] = session;
  }

  bool takes(const urban_nav_store::Table& table, const std::vector<urban_nav_store::Value>& key) {
    const std::string &name = table.name, &session = key.front().bytes;
    if (name == "session" || name == "anchor") return session == first_ || kept_.count(session) != 0;
    const auto found = kept_.find(session);
    if (found == kept_.end() || leftOutTables().count(name) != 0) return false;
    const KeptSession& kept = found->second;
    if (name == "state" && key[1].bytes == "edits.base") return false;
    if (kept.is_whole && name != "edge") return true;
    if (name == "property") return key[1].bytes.rfind("run/", 0) != 0 && key[1].bytes.rfind("input/", 0) != 0;
    if (name == "state") return key[1].bytes.rfind("laser_mapper", 0) == 0 || key[1].bytes == "edits.rendered";
    if (name == "model") return models_.insert({key[1].bytes, session}).first->second == session;
    if (name == "edge") return takesEdge(key);
    const urban_nav_store::Value& last = key.back();
    if (name == "keyframe" || name == "keyframe_place") return kept.keyframes.count(last.integer) != 0;
    if (name == "place") return kept.places.count(last.integer) != 0;
    if (name == "scan") return isWithin(kept.stretches, last.integer * kSecond, (last.integer + 1) * kSecond - 1);
    if (name == "node" || name == "relaxed") return holdsPose(kept, last.integer);
    const std::string& column = table.columns[table.keys - 1].name;
    if (column == "begin_ns") return isWithin(kept.stretches, last.integer, last.integer + laser_mapper::kChunkNs - 1);
    if (column == "stamp_ns") return isWithin(kept.stretches, last.integer, last.integer);
    return true;
  }

 private:
  bool takesEdge(const std::vector<urban_nav_store::Value>& key) const {
    const auto a = kept_.find(key[0].bytes), b = kept_.find(key[2].bytes);
    if (a == kept_.end() || b == kept_.end()) return false;
    const std::optional<urban_nav_store::EdgeKind> kind = urban_nav_store::parseEdgeKind(key[4].bytes);
    if (kind != urban_nav_store::EdgeKind::Odometry)
      return kind == urban_nav_store::EdgeKind::Stereo || kind == urban_nav_store::EdgeKind::Icp;
    return holdsPose(a->second, key[1].integer) && holdsPose(b->second, key[3].integer);
  }

  static bool holdsPose(const KeptSession& kept, StampNs stamp) {
    return kept.is_whole || isWithin(kept.stretches, stamp, stamp) || isNearAny(kept.keyframes, stamp) ||
           isNearAny(kept.places, stamp);
  }

  const SessionId first_;
  std::map<SessionId, KeptSession> kept_;
  std::map<std::string, SessionId> models_;  // by hash: the session whose row is taken
};

}  // namespace

urban_nav_store::RowFilter releaseRows(const std::vector<KeptSession>& sessions, const SessionId& first) {
  const auto selection = std::make_shared<RowSelection>(sessions, first);
  return [selection](const urban_nav_store::Table& table, const std::vector<urban_nav_store::Value>& key) {
    return selection->takes(table, key);
  };
}

}  // namespace urban_nav
