// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/laser_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "chunk_store.hpp"
#include "ghosts/ghost_finder.hpp"
#include "laser_mapper/tile_surface.hpp"
#include "map_state.hpp"
#include "relative_covariance.hpp"
#include "session_chunks.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_mapper {

using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

using Cells = std::vector<MergedCell>;

/// Merged tiles of up to three rows.
class TileRows {
 public:
  void put(const Tile& tile, Cells cells, Cells stereo) {
    tiles_[tile] = std::move(cells);
    if (!stereo.empty()) stereo_[tile] = std::move(stereo);
  }
  void dropBelow(int y) {
    for (std::map<Tile, Cells>* all : {&tiles_, &stereo_})
      while (!all->empty() && all->begin()->first.y < y) all->erase(all->begin());
  }
  bool hasRow(int y) const {
    const auto found = tiles_.lower_bound({-(1 << 24), y});
    return found != tiles_.end() && found->first.y == y;
  }
  const Cells& at(const Tile& tile) const { return tiles_.at(tile); }
  /// Returns the cells of dense stereo.
  const Cells& stereo(const Tile& tile) const {
    static const Cells none;
    const auto found = stereo_.find(tile);
    return found == stereo_.end() ? none : found->second;
  }

  /// Returns the cells around a tile, within kTileMargin.
  Cells margin(const Tile& tile) const {
    Cells around;
    const int x0 = tile.x * kTileCells - kTileMargin, x1 = (tile.x + 1) * kTileCells + kTileMargin;
    const int y0 = tile.y * kTileCells - kTileMargin, y1 = (tile.y + 1) * kTileCells + kTileMargin;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const auto found = dx == 0 && dy == 0 ? tiles_.end() : tiles_.find({tile.x + dx, tile.y + dy});
        if (found == tiles_.end()) continue;
        for (const MergedCell& cell : found->second)
          if (cell.cell.x >= x0 && cell.cell.x < x1 && cell.cell.y >= y0 && cell.cell.y < y1) around.push_back(cell);
      }
    return around;
  }

 private:
  std::map<Tile, Cells> tiles_, stereo_;
};

/// Returns the tiles of each row.
std::map<int, std::vector<Tile>> byRow(const std::set<Tile>& tiles) {
  std::map<int, std::vector<Tile>> rows;
  for (const Tile& tile : tiles) rows[tile.y].push_back(tile);
  return rows;
}

std::vector<const Trajectory*> trajectories(const std::vector<MappedSession>& sessions) {
  std::vector<const Trajectory*> all;
  for (const MappedSession& session : sessions) all.push_back(session.T_map_base);
  return all;
}

}  // namespace

LaserMap::LaserMap(const Parameters& parameters, urban_nav_store::Store& store, std::vector<MappedSession> sessions)
    : parameters_(parameters),
      store_(store),
      sessions_(std::move(sessions)),
      passes_(findPasses(trajectories(sessions_))) {
  for (const MappedSession& session : sessions_)
    covariances_.push_back(
        session.covariances == nullptr || session.covariances->empty()
            ? nullptr
            : std::make_shared<const RelativeCovariances>(*session.T_map_base, *session.covariances));
}

RenderStatistics LaserMap::render(const ProgressCallback& progress) {
  RenderStatistics statistics;
  tiles_.clear();
  std::size_t all = 0, done = 0;
  for (const MappedSession& session : sessions_) all += SessionChunks::count(*session.T_map_base);
  for (const MappedSession& session : sessions_) {
    SessionChunks chunks(parameters_, store_, session.id, *session.T_map_base);
    chunks.update([&](std::size_t now) {
      if (progress) progress(done + now, all);
    });
    done += SessionChunks::count(*session.T_map_base);
    statistics.chunks += chunks.chunks();
    statistics.chunks_rendered += chunks.rendered();
    statistics.beams = statistics.beams + chunks.beams();
    tiles_.insert(chunks.tiles().begin(), chunks.tiles().end());
    for (const std::string& warning : chunks.warnings()) statistics.warnings.push_back(warning);
  }
  if (parameters_.ghosts) GhostFinder(parameters_, store_, sessions_).update();
  for (std::size_t s = 0; s < sessions_.size(); ++s)
    store_.states().put(sessions_[s].id, kMapState,
                        packMapState({parameters_, covariances_[s] ? covariances_[s]->values()
                                                                   : std::vector<urban_nav_core::Matrix6d>()}));
  store_.commit();
  return statistics;
}

void LaserMap::load() {
  tiles_.clear();
  for (std::size_t s = 0; s < sessions_.size(); ++s) {
    for (const auto& [begin, chunk] : ChunkStore(store_, sessions_[s].id).chunks())
      for (const Tile& tile : chunkTiles(chunk)) tiles_.insert(tile);
    const auto bytes = store_.states().get(sessions_[s].id, kMapState);
    std::vector<urban_nav_core::Matrix6d> values;
    if (bytes) values = unpackMapState(*bytes).covariances;
    covariances_[s] = values.empty() ? nullptr : std::make_shared<const RelativeCovariances>(std::move(values));
  }
}

std::optional<Parameters> storedMapParameters(urban_nav_store::Store& store,
                                              const urban_nav_store::SessionId& session) {
  const auto bytes = store.states().get(session, kMapState);
  if (!bytes) return std::nullopt;
  return unpackMapState(*bytes).parameters;
}

LaserMap::MergedTile LaserMap::mergePacked(const Tile& tile, const std::vector<const PackedCells*>& packed) const {
  TileMerger merger, stereo;
  for (const PackedCells* each : packed) {
    const auto cells = unpackCells(tile, each->data);
    if (!cells) throw urban_nav_core::DataError(store_.path(), "points of tile " + toString(tile) + " are damaged", "");
    merger.add(each->source, *cells);
    stereo.add(each->source, *cells, TileMerger::Kind::Stereo);
  }
  const std::size_t ghosts = merger.ghostBeams();
  return {merger.take(), stereo.take(), ghosts};
}

std::vector<std::vector<LaserMap::PackedCells>> LaserMap::readRow(const std::vector<Tile>& tiles) const {
  std::vector<std::vector<PackedCells>> packed(tiles.size());
  for (std::size_t s = 0; s < sessions_.size(); ++s) {
    const ChunkStore chunks(store_, sessions_[s].id);
    for (std::size_t i = 0; i < tiles.size(); ++i)
      chunks.forEachInTile(tiles[i], [&](StampNs begin, std::string data) {
        const CellSource source{static_cast<std::uint16_t>(s), passes_[s].at(begin + kChunkNs / 2), begin};
        packed[i].push_back({source, std::move(data)});
      });
  }
  return packed;
}

std::vector<LaserMap::MergedTile> LaserMap::mergeRow(const std::vector<Tile>& tiles) const {
  const std::vector<std::vector<PackedCells>> packed = readRow(tiles);
  std::vector<MergedTile> merged(tiles.size());
  urban_nav_core::forEach(tiles.size(), 1, [&](std::size_t i) {
    std::vector<const PackedCells*> all;
    for (const PackedCells& each : packed[i]) all.push_back(&each);
    merged[i] = mergePacked(tiles[i], all);
  });
  return merged;
}

void LaserMap::forEachTileByPass(const PassCallback& take) const {
  std::size_t first = 0;
  for (const auto& [y, tiles] : byRow(tiles_)) {
    const std::vector<std::vector<PackedCells>> packed = readRow(tiles);
    urban_nav_core::forEach(tiles.size(), 1, [&, &row_tiles = tiles](std::size_t i) {
      std::map<std::uint16_t, std::vector<const PackedCells*>> by_pass;
      for (const PackedCells& each : packed[i]) by_pass[each.source.pass].push_back(&each);
      std::vector<PassCells> passes;
      for (const auto& [pass, chunks] : by_pass) passes.push_back({pass, mergePacked(row_tiles[i], chunks).cells});
      take(first + i, passes);
    });
    first += tiles.size();
  }
}

double LaserMap::poseSigma(const MergedCell& cell, const Eigen::Vector3d& p, const Eigen::Vector3d& along) const {
  const MappedSession& session = sessions_[cell.session];
  const RelativeCovariances* covariances = covariances_[cell.session].get();
  if (covariances == nullptr || session.T_map_base->empty()) return 0.0;
  const std::size_t pose = session.T_map_base->nearest(cell.stamp);
  const Eigen::Vector3d lever = p - (*session.T_map_base)[pose].pose.t();
  urban_nav_core::Vector6d jacobian;
  jacobian << along, lever.cross(along);
  return std::sqrt(std::max(0.0, jacobian.dot(covariances->at(pose) * jacobian)));
}

std::size_t LaserMap::forEachTile(const TileCallback& take) const {
  const std::map<int, std::vector<Tile>> rows = byRow(tiles_);
  TileRows merged;
  std::size_t ghost_beams = 0;
  const PoseSigma pose_sigma = [this](const MergedCell& cell, const Eigen::Vector3d& p, const Eigen::Vector3d& along) {
    return poseSigma(cell, p, along);
  };
  for (const auto& [y, tiles] : rows) {
    merged.dropBelow(y - 1);
    for (const int next : {y, y + 1})
      if (const auto row = rows.find(next); row != rows.end() && !merged.hasRow(next)) {
        std::vector<MergedTile> made = mergeRow(row->second);
        for (std::size_t i = 0; i < made.size(); ++i) {
          ghost_beams += made[i].ghost_beams;
          merged.put(row->second[i], std::move(made[i].cells), std::move(made[i].stereo));
        }
      }
    std::vector<std::vector<MapPoint>> points(tiles.size());
    urban_nav_core::forEach(tiles.size(), 1, [&, &row_tiles = tiles](std::size_t i) {
      const Tile& tile = row_tiles[i];
      const Cells &cells = merged.at(tile), margin = merged.margin(tile);
      points[i] = makeSurface(parameters_, tile, cells, margin, pose_sigma);
      const std::vector<MapPoint> stereo =
          makeStereoSurface(parameters_, tile, merged.stereo(tile), cells, margin, pose_sigma);
      points[i].insert(points[i].end(), stereo.begin(), stereo.end());
    });
    for (std::size_t i = 0; i < tiles.size(); ++i) take(tiles[i], points[i]);
  }
  return ghost_beams;
}

}  // namespace laser_mapper
