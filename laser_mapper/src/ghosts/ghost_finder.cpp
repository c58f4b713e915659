// SPDX-License-Identifier: BSD-3-Clause
#include "ghosts/ghost_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "laser_mapper/sensors.hpp"
#include "session_chunks.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/bytes.hpp"

namespace laser_mapper {

using Eigen::Vector3d;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_registration::keyBeside;
using urban_nav_registration::toKey;

namespace {

constexpr const char* kGhostState = "laser_mapper_ghosts";
constexpr double kLongestView = 20.0;      // m, from the path
constexpr std::size_t kCachedChunks = 96;  // about 1 MB each
constexpr StampNs kPathStep = 250'000'000;
constexpr std::size_t kCandidatesPerTask = 256, kChunksPerRound = 16, kTilesAtOnce = 8;

/// First and last time of beams in a voxel and its neighbours.
struct SeenTimes {
  StampNs first = std::numeric_limits<StampNs>::max(), last = std::numeric_limits<StampNs>::min();
  void add(StampNs stamp) {
    first = std::min(first, stamp);
    last = std::max(last, stamp);
  }
};

std::string chunkName(const urban_nav_store::SessionId& session, StampNs begin, std::int64_t revision) {
  return session + " " + std::to_string(begin) + " " + std::to_string(revision);
}

}  // namespace

GhostFinder::GhostFinder(const Parameters& parameters, urban_nav_store::Store& store,
                         const std::vector<MappedSession>& sessions)
    : parameters_(parameters), store_(store), sessions_(sessions) {}

bool GhostFinder::isApart(std::size_t a, std::size_t b) const {
  return std::abs(chunks_[a].begin - chunks_[b].begin) >= std::llround(1e9 * parameters_.ghost_gap);
}

void GhostFinder::listChunks() {
  for (std::size_t s = 0; s < sessions_.size(); ++s)
    for (const auto& [begin, stored] : ChunkStore(store_, sessions_[s].id).chunks()) {
      Chunk chunk;
      chunk.session = s;
      chunk.begin = begin;
      chunk.revision = stored.revision;
      chunk.tiles = chunkTiles(stored);
      Vector3d low = Vector3d::Constant(1e300), high = -low;
      for (StampNs stamp = begin; stamp <= begin + kChunkNs; stamp += kPathStep)
        if (const auto pose = sessions_[s].T_map_base->at(stamp, std::llround(1e9 * parameters_.max_gap))) {
          low = low.cwiseMin(pose->t());
          high = high.cwiseMax(pose->t());
        }
      if (!(low.x() <= high.x())) continue;  // without poses there are no cells
      const double edge = kTileCells * parameters_.voxel;
      const auto tile = [&](double value) { return static_cast<int>(std::floor(value / edge)); };
      chunk.reach_low = {tile(low.x() - kLongestView), tile(low.y() - kLongestView)};
      chunk.reach_high = {tile(high.x() + kLongestView), tile(high.y() + kLongestView)};
      chunks_.push_back(std::move(chunk));
    }
}

void GhostFinder::markChanged() {
  const auto bytes = store_.states().get(sessions_.front().id, kGhostState);
  if (!bytes) return;
  std::set<std::string> seen;
  for (urban_nav_store::ByteReader reader(*bytes); reader.ok() && reader.left() > 0;)
    seen.insert(std::string(reader.text()));
  std::size_t unchanged = 0;
  for (Chunk& chunk : chunks_) {
    chunk.changed = seen.erase(chunkName(sessions_[chunk.session].id, chunk.begin, chunk.revision)) == 0;
    unchanged += chunk.changed ? 0 : 1;
  }
  std::set<std::string> now;  // a removed chunk has no list of tiles any more
  for (const Chunk& chunk : chunks_) now.insert(chunkName(sessions_[chunk.session].id, chunk.begin, 0));
  for (const std::string& gone : seen)
    if (now.count(gone.substr(0, gone.rfind(' ')) + " 0") == 0)
      for (Chunk& chunk : chunks_) chunk.changed = true;
}

void GhostFinder::storeState() {
  std::string bytes;
  for (const Chunk& chunk : chunks_)
    urban_nav_store::appendText(bytes, chunkName(sessions_[chunk.session].id, chunk.begin, chunk.revision));
  store_.states().put(sessions_.front().id, kGhostState, bytes);
}

void GhostFinder::readRows(TileTask& task) const {
  for (std::size_t s = 0; s < sessions_.size(); ++s)
    ChunkStore(store_, sessions_[s].id).forEachInTile(task.tile, [&](StampNs begin, std::string data) {
      const auto holder = std::find_if(task.holders.begin(), task.holders.end(), [&](std::size_t c) {
        return chunks_[c].session == s && chunks_[c].begin == begin;
      });
      if (holder != task.holders.end()) task.rows.push_back({*holder, std::move(data), {}, false});
    });
}

void GhostFinder::unpackRows(TileTask& task) const {
  for (Row& row : task.rows) {
    auto cells = unpackCells(task.tile, row.packed);
    if (!cells)
      throw urban_nav_core::DataError(store_.path(), "points of tile " + toString(task.tile) + " are damaged", "");
    row.cells = std::move(*cells);
    row.packed.clear();
  }
}

std::vector<GhostFinder::Candidate> GhostFinder::findCandidates(const std::vector<Row>& rows) const {
  std::size_t all = 0;
  for (const Row& row : rows) all += row.cells.size();
  urban_nav_registration::CellTable table(all);
  std::vector<SeenTimes> times;
  times.reserve(all);
  for (const Row& row : rows)
    for (const MapCell& cell : row.cells) {
      const std::uint32_t number = table.insert(toKey(cell.cell));
      if (number == times.size()) times.emplace_back();
      times[number].add(chunks_[row.chunk].begin);
    }
  const StampNs gap = std::llround(1e9 * parameters_.ghost_gap);
  std::vector<Candidate> candidates;
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t i = 0; i < rows[r].cells.size(); ++i) {
      const MapCell& cell = rows[r].cells[i];
      if (isLidar(cell.laser)) continue;  // decided within its chunk
      const std::uint64_t key = toKey(cell.cell);
      SeenTimes around;
      for (const Cell& beside : {Cell{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
        const std::uint32_t number = table.find(keyBeside(key, beside));
        if (number == urban_nav_registration::CellTable::kNone) continue;
        around.add(times[number].first);
        around.add(times[number].last);
      }
      if (around.last - around.first >= gap) continue;  // occupied at both times
      const Vector3d corner(cell.cell.x, cell.cell.y, cell.cell.z);
      candidates.push_back({r, i, parameters_.voxel * (corner + cell.offset.cast<double>()), 0, 0});
    }
  return candidates;
}

std::vector<std::shared_ptr<const ChunkBeams>> GhostFinder::shareBeams(const std::vector<std::size_t>& chunks) {
  struct Missing {
    std::size_t chunk;
    std::vector<LaserInput> lasers;
    std::shared_ptr<const ChunkBeams> made;
  };
  std::vector<Missing> missing;
  for (const std::size_t chunk : chunks) {
    recent_.remove(chunk);
    recent_.push_front(chunk);
    if (cache_.count(chunk) > 0) continue;
    const urban_nav_store::SessionId& session = sessions_[chunks_[chunk].session].id;
    missing.push_back(
        {chunk, readLasers(store_, session, mountedLasers(store_, session), chunks_[chunk].begin), nullptr});
  }
  urban_nav_core::forEach(missing.size(), 1, [&](std::size_t i) {
    const Trajectory& T_map_base = *sessions_[chunks_[missing[i].chunk].session].T_map_base;
    missing[i].made =
        std::make_shared<const ChunkBeams>(T_map_base, missing[i].lasers, std::llround(1e9 * parameters_.max_gap));
  });
  for (Missing& each : missing) cache_[each.chunk] = std::move(each.made);
  std::vector<std::shared_ptr<const ChunkBeams>> made;
  for (const std::size_t chunk : chunks) made.push_back(cache_.at(chunk));
  for (; recent_.size() > kCachedChunks; recent_.pop_back()) cache_.erase(recent_.back());
  return made;
}

void GhostFinder::lookAtAll(const std::vector<Row>& rows, const std::vector<std::size_t>& chunks,
                            std::vector<Candidate>& candidates) {
  const std::vector<std::shared_ptr<const ChunkBeams>> seen = shareBeams(chunks);
  urban_nav_core::forEach(candidates.size(), kCandidatesPerTask, [&](std::size_t i) {
    Candidate& candidate = candidates[i];
    for (std::size_t c = 0; c < chunks.size(); ++c) {
      if (!isApart(rows[candidate.row].chunk, chunks[c])) continue;
      const Sight sight = seen[c]->look(candidate.p);
      if (sight == Sight::Through) ++candidate.through;
      if (sight == Sight::Hit) ++candidate.hits;
    }
  });
}

void GhostFinder::lookAtCandidates(TileTask& task) {
  if (task.candidates.empty()) return;
  std::vector<std::size_t> asked;
  for (const std::size_t chunk : task.reaching)
    if (std::any_of(task.rows.begin(), task.rows.end(), [&](const Row& row) { return isApart(row.chunk, chunk); }))
      asked.push_back(chunk);
  for (std::size_t first = 0; first < asked.size(); first += kChunksPerRound) {
    const std::vector<std::size_t> round(
        asked.begin() + static_cast<std::ptrdiff_t>(first),
        asked.begin() + static_cast<std::ptrdiff_t>(std::min(asked.size(), first + kChunksPerRound)));
    lookAtAll(task.rows, round, task.candidates);
  }
}

void GhostFinder::flagGhosts(TileTask& task) {
  std::vector<std::vector<std::uint8_t>> ghosts;
  for (const Row& row : task.rows) ghosts.emplace_back(row.cells.size(), 0);
  for (const Candidate& candidate : task.candidates)
    if (candidate.through > candidate.hits) ghosts[candidate.row][candidate.cell] = 1;
  for (std::size_t r = 0; r < task.rows.size(); ++r) {
    Row& row = task.rows[r];
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      if (isLidar(row.cells[i].laser)) continue;
      const bool ghost = ghosts[r][i] != 0;
      row.changed = row.changed || row.cells[i].is_ghost != ghost;
      row.cells[i].is_ghost = ghost;
    }
    if (row.changed) row.packed = packPart(task.tile, row.cells).data;
  }
}

void GhostFinder::updateTiles(std::vector<TileTask>& tasks) {
  for (TileTask& task : tasks) readRows(task);
  urban_nav_core::forEach(tasks.size(), 1, [&](std::size_t i) {
    unpackRows(tasks[i]);
    tasks[i].candidates = findCandidates(tasks[i].rows);
  });
  for (TileTask& task : tasks) lookAtCandidates(task);
  urban_nav_core::forEach(tasks.size(), 1, [&](std::size_t i) { flagGhosts(tasks[i]); });
  for (TileTask& task : tasks)
    for (Row& row : task.rows) {
      if (!row.changed) continue;
      const Chunk& chunk = chunks_[row.chunk];
      ChunkStore(store_, sessions_[chunk.session].id)
          .putCells(chunk.begin, {task.tile, static_cast<std::int64_t>(row.cells.size()), std::move(row.packed)});
    }
  tasks.clear();
}

void GhostFinder::update() {
  if (sessions_.empty()) return;
  listChunks();
  markChanged();
  std::map<Tile, std::vector<std::size_t>> holders;
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    for (const Tile& tile : chunks_[c].tiles) holders[tile].push_back(c);
  std::vector<TileTask> tasks;
  for (auto& [tile, chunks] : holders) {
    std::vector<std::size_t> reaching;
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      const Chunk& chunk = chunks_[c];
      if (tile.x >= chunk.reach_low.x && tile.x <= chunk.reach_high.x && tile.y >= chunk.reach_low.y &&
          tile.y <= chunk.reach_high.y)
        reaching.push_back(c);
    }
    const auto isChanged = [&](std::size_t c) { return chunks_[c].changed; };
    if (std::none_of(chunks.begin(), chunks.end(), isChanged) &&
        std::none_of(reaching.begin(), reaching.end(), isChanged))
      continue;
    tasks.push_back({tile, std::move(chunks), std::move(reaching), {}, {}});
    if (tasks.size() == kTilesAtOnce) updateTiles(tasks);
  }
  updateTiles(tasks);
  storeState();
}

}  // namespace laser_mapper
