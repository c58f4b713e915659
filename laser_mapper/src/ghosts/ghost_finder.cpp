// SPDX-License-Identifier: BSD-3-Clause
#include "ghosts/ghost_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "session_chunks.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/bytes.hpp"

namespace laser_mapper {

using Eigen::Vector3d;
using urban_nav_core::StampNs;
using urban_nav_registration::keyBeside;
using urban_nav_registration::toKey;

namespace {

constexpr const char* kGhostState = "laser_mapper_ghosts";
constexpr double kLongestSight = 20.0;     // m, from the path
constexpr std::size_t kCachedChunks = 96;  // some 1 MB each
constexpr StampNs kPathStep = 250'000'000;
constexpr std::size_t kCandidatesPerTask = 256, kChunksPerRound = 16;

/// First and last time at which a cube and those beside it had a beam.
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
      if (!(low.x() <= high.x())) continue;  // no pose, hence no cells
      const double edge = kTileCells * parameters_.voxel;
      const auto tile = [&](double value) { return static_cast<int>(std::floor(value / edge)); };
      chunk.reach_low = {tile(low.x() - kLongestSight), tile(low.y() - kLongestSight)};
      chunk.reach_high = {tile(high.x() + kLongestSight), tile(high.y() + kLongestSight)};
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
  std::set<std::string> now;  // a chunk that is gone has left no list of its tiles
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

std::vector<GhostFinder::Row> GhostFinder::readRows(const Tile& tile, const std::vector<std::size_t>& holders) const {
  std::vector<Row> rows;
  for (std::size_t s = 0; s < sessions_.size(); ++s)
    ChunkStore(store_, sessions_[s].id).forEachInTile(tile, [&](StampNs begin, const std::string& data) {
      const auto holder = std::find_if(holders.begin(), holders.end(), [&](std::size_t c) {
        return chunks_[c].session == s && chunks_[c].begin == begin;
      });
      if (holder == holders.end()) return;
      auto cells = unpackCells(tile, data);
      if (!cells)
        throw urban_nav_core::DataError(store_.path(), "points of tile " + toString(tile) + " are damaged", "");
      rows.push_back({*holder, std::move(*cells), false});
    });
  return rows;
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
      const std::uint64_t key = toKey(cell.cell);
      SeenTimes around;
      for (const Cell& beside : {Cell{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
        const std::uint32_t number = table.find(keyBeside(key, beside));
        if (number == urban_nav_registration::CellTable::none) continue;
        around.add(times[number].first);
        around.add(times[number].last);
      }
      if (around.last - around.first >= gap) continue;  // there at both times
      const Vector3d corner(cell.cell.x, cell.cell.y, cell.cell.z);
      candidates.push_back({r, i, parameters_.voxel * (corner + cell.offset.cast<double>()), 0, 0});
    }
  return candidates;
}

std::shared_ptr<const ChunkBeams> GhostFinder::beams(std::size_t chunk) {
  const auto found = cache_.find(chunk);
  recent_.remove(chunk);
  recent_.push_front(chunk);
  if (found != cache_.end()) return found->second;
  const Chunk& at = chunks_[chunk];
  const MappedSession& session = sessions_[at.session];
  auto made = std::make_shared<const ChunkBeams>(
      *session.T_map_base, readLasers(store_, session.id, mountedLasers(store_, session.id), at.begin),
      std::llround(1e9 * parameters_.max_gap));
  cache_[chunk] = made;
  if (recent_.size() > kCachedChunks) {
    cache_.erase(recent_.back());
    recent_.pop_back();
  }
  return made;
}

void GhostFinder::lookAtAll(const std::vector<Row>& rows, const std::vector<std::size_t>& chunks,
                            std::vector<Candidate>& candidates) {
  std::vector<std::shared_ptr<const ChunkBeams>> seen;
  for (const std::size_t chunk : chunks) seen.push_back(beams(chunk));
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

void GhostFinder::updateTile(const Tile& tile, const std::vector<std::size_t>& holders,
                             const std::vector<std::size_t>& reaching) {
  std::vector<Row> rows = readRows(tile, holders);
  std::vector<Candidate> candidates = findCandidates(rows);
  std::vector<std::size_t> asked;
  for (const std::size_t chunk : reaching)
    if (std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return isApart(row.chunk, chunk); }))
      asked.push_back(chunk);
  if (candidates.empty()) asked.clear();
  for (std::size_t first = 0; first < asked.size(); first += kChunksPerRound) {
    const std::vector<std::size_t> round(
        asked.begin() + static_cast<std::ptrdiff_t>(first),
        asked.begin() + static_cast<std::ptrdiff_t>(std::min(asked.size(), first + kChunksPerRound)));
    lookAtAll(rows, round, candidates);
  }
  std::vector<std::vector<std::uint8_t>> ghosts;
  for (const Row& row : rows) ghosts.emplace_back(row.cells.size(), 0);
  for (const Candidate& candidate : candidates)
    if (candidate.through > candidate.hits) ghosts[candidate.row][candidate.cell] = 1;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t i = 0; i < rows[r].cells.size(); ++i) {
      const bool ghost = ghosts[r][i] != 0;
      rows[r].changed = rows[r].changed || rows[r].cells[i].is_ghost != ghost;
      rows[r].cells[i].is_ghost = ghost;
    }
    if (!rows[r].changed) continue;
    const Chunk& chunk = chunks_[rows[r].chunk];
    ChunkStore(store_, sessions_[chunk.session].id).putCells(tile, chunk.begin, rows[r].cells);
  }
}

void GhostFinder::update() {
  if (sessions_.empty()) return;
  listChunks();
  markChanged();
  std::map<Tile, std::vector<std::size_t>> holders;
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    for (const Tile& tile : chunks_[c].tiles) holders[tile].push_back(c);
  for (const auto& [tile, chunks] : holders) {
    std::vector<std::size_t> reaching;
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
      const Chunk& chunk = chunks_[c];
      if (tile.x >= chunk.reach_low.x && tile.x <= chunk.reach_high.x && tile.y >= chunk.reach_low.y &&
          tile.y <= chunk.reach_high.y)
        reaching.push_back(c);
    }
    const auto isChanged = [&](std::size_t c) { return chunks_[c].changed; };
    if (std::any_of(chunks.begin(), chunks.end(), isChanged) ||
        std::any_of(reaching.begin(), reaching.end(), isChanged))
      updateTile(tile, chunks, reaching);
  }
  storeState();
}

}  // namespace laser_mapper
