// SPDX-License-Identifier: BSD-3-Clause
#include "quality/pass_blocks.hpp"

#include <cmath>

namespace laser_mapper {

using Eigen::Vector3d;

namespace {

constexpr int kBlockCubes = kPlaceSpacing;
static_assert(kTileCells % kBlockCubes == 0 && kBlockCubes == 1 << 4, "a tile consists of whole blocks");

}  // namespace

PassBlocks::PassBlocks(double voxel, const PassCells& pass) : edge_(kBlockCubes * voxel), pass_(pass.pass) {
  for (const MergedCell& cell : pass.cells) {
    const Vector3d corner(cell.cell.x, cell.cell.y, cell.cell.z);
    const std::uint64_t key = urban_nav_registration::toKey({cell.cell.x >> 4, cell.cell.y >> 4, cell.cell.z >> 4});
    const std::uint32_t number = table_.insert(key);
    if (number == blocks_.size()) blocks_.push_back({key, {}});
    blocks_[number].cells.push_back({voxel * (corner + cell.offset.cast<double>()), &cell});
  }
}

std::uint64_t PassBlocks::blockKey(const Vector3d& p) const {
  const auto part = [&](double value) { return static_cast<int>(std::floor(value / edge_)); };
  return urban_nav_registration::toKey({part(p.x()), part(p.y()), part(p.z())});
}

std::vector<PlacedCell> PassBlocks::around(const Vector3d& centre, const Vector3d& normal, double radius,
                                           double reach) const {
  std::vector<PlacedCell> cells;
  const std::uint64_t middle = blockKey(centre);
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const std::uint32_t number = table_.find(urban_nav_registration::keyBeside(middle, {dx, dy, dz}));
        if (number == urban_nav_registration::CellTable::kNone) continue;
        for (const PlacedCell& placed : blocks_[number].cells) {
          const Vector3d d = placed.p - centre;
          const double along = normal.dot(d);
          if (std::abs(along) < reach && (d - along * normal).squaredNorm() < radius * radius) cells.push_back(placed);
        }
      }
  return cells;
}

}  // namespace laser_mapper
