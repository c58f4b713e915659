// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/tiles/tile_store.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/deflate.hpp"
#include "urban_nav_store/digest.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/map_tile.hpp"

namespace laser_mapper {

using urban_nav_core::DataError;
using urban_nav_core::StampNs;
using urban_nav_store::MapTile;
using urban_nav_store::SessionId;
using urban_nav_store::Store;
using urban_nav_store::TableStore;

namespace {

constexpr std::size_t kMaxTileBytes = std::size_t{1} << 30;
constexpr std::size_t kMostUncommitted = std::size_t{32} << 20;
constexpr std::size_t kLengthBytes = 8;  // before the zlib data of deflated()

ListedTile describe(const LevelTile& tile, const std::vector<TilePoint>& points) {
  ListedTile listed;
  listed.tile = tile;
  listed.points = static_cast<std::uint32_t>(points.size());
  listed.lowest = points.front().z;
  listed.highest = points.back().z;
  listed.session = points[points.size() / 2].session;
  listed.pose = points[points.size() / 2].pose;
  return listed;
}

}  // namespace

std::vector<TiledSession> tiledSessions(Store& store, const std::vector<MappedSession>& sessions,
                                        const std::vector<SessionPasses>& passes) {
  std::vector<TiledSession> tiled;
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    TiledSession each{sessions[s].id, std::nullopt, {}};
    if (!passes[s].begins.empty()) each.first_pass = passes[s].begins.front().pass;
    store.graph().forEachNode(each.id, [&](const urban_nav_store::Node& node) { each.stamps.push_back(node.stamp); });
    tiled.push_back(std::move(each));
  }
  return tiled;
}

void forgetTiles(Store& store, const SessionId& session) {
  TableStore<MapTile> rows(store);
  const std::optional<TileList> list = storedTileList(store, session);
  rows.remove({session, "", 0, ""});
  if (list)
    for (const ListedTile& tile : list->tiles) rows.remove({session, toString(tile.tile), 0, ""});
  std::vector<std::string> others;  // left by a writer that did not finish
  rows.forEach(session, [&](const MapTile& row) { others.push_back(row.tile); });
  for (const std::string& tile : others) rows.remove({session, tile, 0, ""});
}

TileWriter::TileWriter(Store& store, std::vector<TiledSession> sessions, double voxel)
    : store_(store), sessions_(std::move(sessions)) {
  list_.voxel = voxel;
  for (const TiledSession& session : sessions_) {
    forgetTiles(store, session.id);
    if (session.first_pass) by_pass_.emplace_back(*session.first_pass, list_.sessions.size());
    list_.sessions.push_back({session.id, static_cast<std::uint32_t>(session.stamps.size())});
  }
}

TilePoint TileWriter::toStored(const MapPoint& point) const {
  TilePoint stored = toTilePoint(point, list_.voxel);
  const auto after = std::upper_bound(by_pass_.begin(), by_pass_.end(), point.pass,
                                      [](std::uint16_t pass, const auto& first) { return pass < first.first; });
  if (after == by_pass_.begin()) return stored;
  stored.session = (after - 1)->second;
  const std::vector<StampNs>& stamps = sessions_[stored.session].stamps;
  if (stamps.empty()) return stored;
  auto next = std::lower_bound(stamps.begin(), stamps.end(), point.stamp);
  if (next == stamps.end() || (next != stamps.begin() && point.stamp - *(next - 1) <= *next - point.stamp)) --next;
  stored.pose = static_cast<std::uint32_t>(next - stamps.begin());
  return stored;
}

void TileWriter::add(const Tile& tile, const std::vector<MapPoint>& points) {
  if (row_ && tile.y > *row_) closeRowsBelow(tile.y - 1);
  row_ = tile.y;
  for (const MapPoint& each : points) {
    const TilePoint point = toStored(each);
    const Tile at = finestTile(point);
    if (std::abs(at.x - tile.x) > 1 || std::abs(at.y - tile.y) > 1)
      throw std::logic_error("a point of tile " + toString(tile) + " lies in tile " + toString(at));
    points_[at].push_back(point);
  }
}

void TileWriter::closeRowsBelow(int y) {
  std::vector<std::pair<Tile, std::vector<TilePoint>>> closed;
  while (!points_.empty() && points_.begin()->first.y < y) {
    closed.emplace_back(points_.begin()->first, std::move(points_.begin()->second));
    points_.erase(points_.begin());
  }
  std::vector<Levels> levels(closed.size());
  urban_nav_core::forEach(closed.size(), 1,
                          [&](std::size_t i) { levels[i] = divideIntoLevels(std::move(closed[i].second)); });
  std::vector<std::pair<LevelTile, std::vector<TilePoint>>> complete;
  for (int level = 0; level <= kCoarsestLevel; ++level) {
    const auto index = static_cast<std::size_t>(level);
    Pending& pending = pending_[index];
    for (std::size_t i = 0; i < closed.size(); ++i) {
      const std::vector<TilePoint>& points = levels[i][index];
      if (points.empty()) continue;
      std::vector<TilePoint>& into = pending[coveringTile(closed[i].first, level).tile];
      into.insert(into.end(), points.begin(), points.end());
    }
    while (!pending.empty() &&
           (static_cast<std::int64_t>(pending.begin()->first.y) + 1) * (std::int64_t{1} << level) <= y) {
      complete.emplace_back(LevelTile{level, pending.begin()->first}, std::move(pending.begin()->second));
      pending.erase(pending.begin());
    }
  }
  write(complete);
}

void TileWriter::write(const std::vector<std::pair<LevelTile, std::vector<TilePoint>>>& tiles) {
  std::vector<std::string> packed(tiles.size());
  std::vector<ListedTile> listed(tiles.size());
  urban_nav_core::forEach(tiles.size(), 1, [&](std::size_t i) {
    std::vector<TilePoint> points = tiles[i].second;
    std::sort(points.begin(), points.end());
    listed[i] = describe(tiles[i].first, points);
    packed[i] = urban_nav_store::deflated(printTile(tiles[i].first, points));
  });
  TableStore<MapTile> rows(store_);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    list_.digest = urban_nav_store::sha256(list_.digest + packed[i]);
    uncommitted_ += packed[i].size();
    rows.put({sessions_.front().id, toString(tiles[i].first), std::int64_t{listed[i].points}, std::move(packed[i])});
    list_.tiles.push_back(listed[i]);
  }
  if (uncommitted_ < kMostUncommitted) return;
  store_.commit();
  uncommitted_ = 0;
}

void TileWriter::finish() {
  closeRowsBelow(std::numeric_limits<int>::max());
  if (!sessions_.empty() && !list_.tiles.empty()) {
    std::sort(list_.tiles.begin(), list_.tiles.end(), [](const ListedTile& a, const ListedTile& b) {
      return a.tile.level != b.tile.level ? a.tile.level > b.tile.level : a.tile.tile < b.tile.tile;
    });
    TableStore<MapTile>(store_).put(
        {sessions_.front().id, "", static_cast<std::int64_t>(list_.points()), packTileList(list_)});
  }
  store_.commit();
}

std::optional<TileList> storedTileList(Store& store, const SessionId& first) {
  const std::optional<MapTile> row = TableStore<MapTile>(store).get({first, "", 0, ""});
  if (!row) return std::nullopt;
  std::optional<TileList> list = unpackTileList(row->data);
  if (!list) throw DataError(store.path(), "the list of the tiles of session " + first + " is damaged", "");
  return list;
}

std::optional<std::string> storedTile(Store& store, const SessionId& first, const LevelTile& tile) {
  std::optional<MapTile> row = TableStore<MapTile>(store).get({first, toString(tile), 0, ""});
  if (!row || row->data.size() < kLengthBytes) return std::nullopt;
  return row->data.substr(kLengthBytes);
}

std::vector<TilePoint> storedTilePoints(Store& store, const SessionId& first, const LevelTile& tile) {
  const std::optional<MapTile> row = TableStore<MapTile>(store).get({first, toString(tile), 0, ""});
  if (!row) return {};
  const std::optional<std::string> bytes = urban_nav_store::inflated(row->data, kMaxTileBytes);
  std::optional<std::vector<TilePoint>> points = bytes ? readTile(tile, *bytes) : std::nullopt;
  if (!points) throw DataError(store.path(), "tile " + toString(tile) + " of the map is damaged", "");
  return *points;
}

}  // namespace laser_mapper
