// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/tiles/tile_list.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/deflate.hpp"

namespace laser_mapper {

using urban_nav_store::ByteReader;

namespace {

constexpr std::uint32_t kEncoding = 1;
constexpr std::size_t kMaxListBytes = std::size_t{1} << 28;
constexpr std::size_t kListedBytes = 32;

std::uint32_t toUnsigned(std::int32_t value) { return static_cast<std::uint32_t>(value); }
std::int32_t toSigned(std::uint32_t value) { return static_cast<std::int32_t>(value); }

}  // namespace

std::uint64_t TileList::points() const {
  std::uint64_t all = 0;
  for (const ListedTile& tile : tiles) all += tile.points;
  return all;
}

std::string packTileList(const TileList& list) {
  std::string bytes;
  urban_nav_store::appendInteger32(bytes, kEncoding);
  urban_nav_store::appendNumber(bytes, list.voxel);
  urban_nav_store::appendText(bytes, list.digest);
  urban_nav_store::appendInteger(bytes, list.sessions.size());
  for (const TileList::MappedPoses& each : list.sessions) {
    urban_nav_store::appendText(bytes, each.session);
    urban_nav_store::appendInteger32(bytes, each.poses);
  }
  urban_nav_store::appendInteger(bytes, list.tiles.size());
  for (const ListedTile& tile : list.tiles)
    for (const std::uint32_t value :
         {toUnsigned(tile.tile.level), toUnsigned(tile.tile.tile.x), toUnsigned(tile.tile.tile.y), tile.points,
          toUnsigned(tile.lowest), toUnsigned(tile.highest), std::uint32_t{tile.session}, tile.pose})
      urban_nav_store::appendInteger32(bytes, value);
  return urban_nav_store::deflated(bytes);
}

std::optional<TileList> unpackTileList(std::string_view packed) {
  const std::optional<std::string> bytes = urban_nav_store::inflated(packed, kMaxListBytes);
  if (!bytes) return std::nullopt;
  ByteReader reader(*bytes);
  if (reader.integer32() != kEncoding) return std::nullopt;
  TileList list;
  list.voxel = reader.number();
  list.digest = reader.text();
  const std::uint64_t sessions = reader.integer();
  if (!reader.ok() || !(list.voxel > 0.0) || sessions > reader.left()) return std::nullopt;
  for (std::uint64_t i = 0; i < sessions; ++i) {
    std::string session(reader.text());
    list.sessions.push_back({std::move(session), reader.integer32()});
  }
  const std::uint64_t tiles = reader.integer();
  if (!reader.ok() || tiles > reader.left() / kListedBytes) return std::nullopt;
  for (std::uint64_t i = 0; i < tiles; ++i) {
    ListedTile tile;
    tile.tile.level = toSigned(reader.integer32());
    tile.tile.tile.x = toSigned(reader.integer32());
    tile.tile.tile.y = toSigned(reader.integer32());
    tile.points = reader.integer32();
    tile.lowest = toSigned(reader.integer32());
    tile.highest = toSigned(reader.integer32());
    tile.session = static_cast<std::uint16_t>(reader.integer32());
    tile.pose = reader.integer32();
    if (tile.tile.level < 0 || tile.tile.level > kCoarsestLevel || tile.session >= list.sessions.size())
      return std::nullopt;
    list.tiles.push_back(tile);
  }
  if (!reader.complete()) return std::nullopt;
  return list;
}

std::vector<ListedTile> selectTiles(const TileList& list, const std::optional<std::array<double, 4>>& extent,
                                    std::uint64_t budget) {
  struct Candidate {
    int level = 0;
    double distance = 0.0;  ///< m, of the middle of the tile from that of the extent; 0 without an extent
    ListedTile tile;
  };
  std::vector<Candidate> candidates;
  for (const ListedTile& tile : list.tiles) {
    Candidate candidate{tile.tile.level, 0.0, tile};
    if (extent) {
      const double width = list.width(tile.tile.level);
      const double x = tile.tile.tile.x * width, y = tile.tile.tile.y * width;
      const auto& [x0, y0, x1, y1] = *extent;
      if (x > x1 || y > y1 || x + width < x0 || y + width < y0) continue;
      candidate.distance = std::hypot(x + 0.5 * width - 0.5 * (x0 + x1), y + 0.5 * width - 0.5 * (y0 + y1));
    }
    candidates.push_back(candidate);
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.level != b.level ? a.level > b.level : a.distance < b.distance;
  });
  std::vector<ListedTile> selected;
  std::uint64_t points = 0;
  for (const Candidate& candidate : candidates) {
    points += candidate.tile.points;
    if (points > budget) break;
    selected.push_back(candidate.tile);
  }
  return selected;
}

}  // namespace laser_mapper
