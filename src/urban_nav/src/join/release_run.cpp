// SPDX-License-Identifier: BSD-3-Clause
#include "join/release_run.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "inspect/stores_command.hpp"
#include "join/workplace.hpp"
#include "topics/lasers/map_export.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/parameters.hpp"
#include "urban_nav_store/stored_ids.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav {

using urban_nav_core::DataError;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;
using urban_nav_store::Access;
using urban_nav_store::ReleaseHead;
using urban_nav_store::Store;
using urban_nav_store::StoredPlace;
using urban_nav_store::StoredTrajectory;

namespace {

constexpr StampNs kPlaceGap = 1'000'000'000;  // ns between the poses before and after a place
constexpr double kSamePlaceDistance = 3.0;  // m: a place with one of the other release within this distance is not lost
constexpr double kMoved = 0.1;              // m
constexpr double kSurfaceCell = 0.25;       // m: surfaces are compared by cells and their neighbours

using Voxel = std::tuple<int, int, int>;

/// Content for the comparison of two releases.
struct ReleaseContent {
  ReleaseHead head;
  std::map<std::pair<std::string, StampNs>, Vector3d> places;
  std::set<Voxel> surfaces;
  bool has_surfaces = false;
};

/// Removes thumbnails from the places of a release, since localization does not need them.
void removeThumbnails(Store& store, const std::vector<KeptSession>& kept) {
  urban_nav_store::TableStore<StoredPlace> places(store);
  for (const KeptSession& session : kept)
    for (const StampNs stamp : session.places) {
      StoredPlace key;
      key.session = session.id;
      key.stamp = stamp;
      std::optional<StoredPlace> row = places.get(key);
      if (!row || row->thumbnail.empty()) continue;
      row->thumbnail.clear();
      places.put(*row);
    }
}

ReleaseContent readContent(const std::string& path, double memory_mb) {
  Store store = urban_nav_store::openForReading(path, Access::Frozen);
  ReleaseContent content;
  content.head = readReleaseHead(store);
  const auto maps = readMaps(store, store.sessions().all());
  if (maps.empty()) return content;
  for (const StoredTrajectory& session : maps.front()) {
    const urban_nav_core::Trajectory trajectory(session.T_map_base);
    if (trajectory.empty()) continue;
    urban_nav_store::TableStore<StoredPlace>(store).forEach(session.session.id, [&](const StoredPlace& row) {
      if (const auto pose = trajectory.at(row.stamp, kPlaceGap))
        content.places[{session.session.id, row.stamp}] = pose->t();
    });
  }
  content.has_surfaces = holdsMap(store, maps.front());
  if (content.has_surfaces)
    forEachMapTile(store, maps.front(), memory_mb, [&](const std::vector<laser_mapper::MapPoint>& points) {
      for (const laser_mapper::MapPoint& point : points) {
        const auto number = [](double value) { return static_cast<int>(std::floor(value / kSurfaceCell)); };
        content.surfaces.insert({number(point.p.x()), number(point.p.y()), number(point.p.z())});
      }
    });
  return content;
}

/// Returns the number of places of `a` without one of `b` nearby.
std::size_t countLost(const ReleaseContent& a, const ReleaseContent& b) {
  std::map<std::pair<int, int>, std::vector<Vector3d>> cells;
  const auto toCell = [](const Vector3d& p) {
    return std::make_pair(static_cast<int>(std::floor(p.x() / kSamePlaceDistance)),
                          static_cast<int>(std::floor(p.y() / kSamePlaceDistance)));
  };
  for (const auto& [key, p] : b.places) cells[toCell(p)].push_back(p);
  std::size_t lost = 0;
  for (const auto& [key, p] : a.places) {
    bool is_there = false;
    const auto [x, y] = toCell(p);
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        if (const auto cell = cells.find({x + dx, y + dy}); cell != cells.end())
          is_there = is_there || std::any_of(cell->second.begin(), cell->second.end(), [&, &at = p](const Vector3d& q) {
                       return (q - at).norm() <= kSamePlaceDistance;
                     });
    lost += is_there ? 0 : 1;
  }
  return lost;
}

/// Returns the area of the surfaces of `a` that are missing in `b`, m2.
double areaLost(const ReleaseContent& a, const ReleaseContent& b) {
  std::size_t lost = 0;
  for (const auto& [x, y, z] : a.surfaces) {
    bool is_there = false;
    for (int n = 0; n < 27 && !is_there; ++n)
      is_there = b.surfaces.count({x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1}) != 0;
    lost += is_there ? 0 : 1;
  }
  return static_cast<double>(lost) * kSurfaceCell * kSurfaceCell;
}

bool areRelated(const ReleaseHead& a, const ReleaseHead& b) {
  const auto isAmong = [](const std::string& digest, const std::vector<std::string>& digests) {
    return std::find(digests.begin(), digests.end(), digest) != digests.end();
  };
  return a.digest == b.digest || isAmong(a.digest, b.parents) || isAmong(b.digest, a.parents) ||
         std::any_of(a.parents.begin(), a.parents.end(),
                     [&](const std::string& parent) { return isAmong(parent, b.parents); });
}

}  // namespace

ReleaseRun writeRelease(const std::string& source, const std::vector<KeptSession>& kept,
                        const urban_nav_store::SessionId& first, ReleaseHead head, const std::string& out) {
  Workplace workplace(out);
  urban_nav_store::copyRows(source, workplace.store(), releaseRows(kept, first));
  ReleaseRun run;
  {
    Store store(workplace.store(), Access::Write);
    removeThumbnails(store, kept);
    store.commit();
    store.close();
  }
  for (const KeptSession& session : kept) {
    ++run.sessions;
    run.places += session.places.size();
    run.keyframes += session.keyframes.size();
  }
  run.head = urban_nav_store::freeze(workplace.store(), first, std::move(head), out);
  run.bytes = static_cast<std::int64_t>(std::filesystem::file_size(out));
  return run;
}

ReleaseRun makeRelease(const std::string& path, const std::string& out, const ParameterSet& parameters) {
  requireFinished(path);
  std::vector<KeptSession> kept;
  urban_nav_store::SessionId first;
  std::size_t left_out = 0;
  {
    Store store = urban_nav_store::openForReading(path, Access::Snapshot);
    const auto maps = readMaps(store, store.sessions().all());
    if (maps.empty()) throw DataError(path, "holds no session", "a store written by map");
    for (std::size_t m = 1; m < maps.size(); ++m) left_out += maps[m].size();
    first = maps.front().front().map;
    ReleaseSelection selection(parameters.get(urban_nav_registration::table()).cloud_half_length);
    for (const StoredTrajectory& session : maps.front()) {
      KeptSession its = selection.add(store, session);
      if (!its.isEmpty()) kept.push_back(std::move(its));
    }
    if (!store.sessions().find(first)) first = maps.front().front().session.id;
  }
  const bool has_views =
      std::any_of(kept.begin(), kept.end(), [](const KeptSession& session) { return !session.keyframes.empty(); });
  if (!has_views)
    throw DataError(path, "has no keyframes for localisation", "a store of map with stages vo, places and loops");
  ReleaseRun run = writeRelease(path, kept, first, {}, out);
  if (left_out > 0)
    run.warnings.push_back(std::to_string(left_out) +
                           " sessions are left out: they are in other maps (urban_nav join makes one map of those "
                           "that show the same places)");
  return run;
}

ReleaseDifference compareReleases(const std::string& a, const std::string& b, double memory_mb) {
  const ReleaseContent before = readContent(a, memory_mb), after = readContent(b, memory_mb);
  if (!areRelated(before.head, after.head))
    throw DataError(b, "shares no parent with " + a + ": their maps have no common frame",
                    "releases of which one was made from the other by join --onto");
  ReleaseDifference difference;
  difference.places_lost = countLost(before, after);
  difference.places_new = countLost(after, before);
  for (const auto& [key, p] : before.places)
    if (const auto other = after.places.find(key); other != after.places.end() && (other->second - p).norm() > kMoved)
      ++difference.places_moved;
  if (before.has_surfaces && after.has_surfaces) {
    difference.surfaces_gone_m2 = areaLost(before, after);
    difference.surfaces_new_m2 = areaLost(after, before);
  } else {
    difference.warnings.emplace_back("surfaces are not compared: a release has no point map");
  }
  return difference;
}

}  // namespace urban_nav
