// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/tiles/levels.hpp"

#include <algorithm>
#include <utility>

#include "urban_nav_registration/cloud/cell_table.hpp"

namespace laser_mapper {

namespace {

constexpr int kVoxelShift = 8;
static_assert(1 << kVoxelShift == kVoxelSteps);

/// Mixes the bits of a position (finaliser of splitmix64: Steele, Lea and Flood 2014).
std::uint64_t mixedBits(const TilePoint& point) {
  auto bits = static_cast<std::uint64_t>(static_cast<std::uint32_t>(point.x)) << 32U |
              static_cast<std::uint64_t>(static_cast<std::uint32_t>(point.y));
  bits ^= static_cast<std::uint64_t>(static_cast<std::uint32_t>(point.z)) << 16U;
  bits = (bits ^ bits >> 30U) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ bits >> 27U) * 0x94d049bb133111ebU;
  return bits ^ bits >> 31U;
}

std::uint64_t voxelKey(const TilePoint& point, int level) {
  const int shift = kVoxelShift + level;
  return urban_nav_registration::toKey({point.x >> shift, point.y >> shift, point.z >> shift});
}

}  // namespace

Levels divideIntoLevels(std::vector<TilePoint> points) {
  std::vector<std::pair<std::uint64_t, TilePoint>> ordered;
  ordered.reserve(points.size());
  for (const TilePoint& point : points) ordered.emplace_back(mixedBits(point), point);
  std::sort(ordered.begin(), ordered.end());
  std::vector<urban_nav_registration::CellTable> opened;
  for (int level = 0; level <= kCoarsestLevel; ++level)
    opened.emplace_back(std::max<std::size_t>(16, points.size() >> (2 * level)));
  Levels levels;
  for (const auto& [bits, point] : ordered) {
    // A voxel that this point opens lies in the voxels that it opens at coarser levels, if any.
    std::size_t level = 0;
    for (std::size_t at = 0; at < opened.size(); ++at) {
      const std::size_t before = opened[at].size();
      opened[at].insert(voxelKey(point, static_cast<int>(at)));
      if (opened[at].size() == before) break;
      level = at;
    }
    levels[level].push_back(point);
  }
  for (std::vector<TilePoint>& level : levels) std::sort(level.begin(), level.end());
  return levels;
}

}  // namespace laser_mapper
