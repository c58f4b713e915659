// SPDX-License-Identifier: BSD-3-Clause
#include "chunk_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace laser_mapper {

using urban_nav_core::LaserPoint;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_registration::toKey;

namespace {

/// Returns a sort key: by tile, then z, y and x within it.
std::uint64_t orderKey(const Cell& cell) {
  const Tile tile = tileAt(cell);
  const auto part = [](int value, int bias) { return static_cast<std::uint64_t>(value + bias); };
  constexpr int kFarthestTile = (urban_nav_registration::kFarthestCell + kTileCells) / kTileCells;
  return part(tile.y, kFarthestTile) << 45U | part(tile.x, kFarthestTile) << 32U |
         part(cell.z, kMaxHeightCell + 1) << 16U | part(cell.y - tile.y * kTileCells, 0) << 8U |
         part(cell.x - tile.x * kTileCells, 0);
}

}  // namespace

ChunkGrid::ChunkGrid(double voxel, const Eigen::Vector3d& centre, StampNs begin)
    : per_m_(static_cast<float>(1.0 / voxel)), begin_(begin), table_(1 << 14) {
  const Eigen::Vector3d cells = (centre / voxel).array().round();
  origin_cell_ = {static_cast<int>(cells.x()), static_cast<int>(cells.y()), static_cast<int>(cells.z())};
  origin_ = voxel * cells;
}

Pose ChunkGrid::framePose() const { return Pose(Eigen::Quaterniond::Identity(), origin_).inverse(); }

bool ChunkGrid::add(const LaserPoint& point, std::uint8_t sensor, float weight, int count) {
  const Eigen::Vector3f scaled = point.p * per_m_;
  const Eigen::Vector3f corner = scaled.array().floor();
  const Cell cell{static_cast<int>(corner.x()) + origin_cell_.x, static_cast<int>(corner.y()) + origin_cell_.y,
                  static_cast<int>(corner.z()) + origin_cell_.z};
  if (std::abs(cell.x) > urban_nav_registration::kFarthestCell ||
      std::abs(cell.y) > urban_nav_registration::kFarthestCell || std::abs(cell.z) > kMaxHeightCell)
    return false;
  const std::uint32_t number = table_.insert(toKey(cell));
  if (number == sums_.size()) {
    sums_.emplace_back();
    sums_.back().cell = cell;
  }
  Sums& sums = sums_[number];
  sums.offset += weight * (scaled - corner);
  sums.to_laser += weight * (point.origin - point.p) / std::max(point.range, 1e-6F);
  sums.range += weight * point.range;
  sums.intensity += weight * point.intensity;
  sums.weight += weight;
  sums.time += point.stamp - begin_;
  ++sums.points;
  sums.count += count;
  if (sums.sensor_votes == 0) sums.sensor = sensor;
  sums.sensor_votes += sums.sensor == sensor ? 1 : -1;
  return true;
}

void ChunkGrid::markGhosts(const std::function<bool(std::uint8_t)>& of_sensor,
                           const std::function<bool(const Eigen::Vector3d&)>& is_ghost) {
  struct Block {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    float cubes = 0.0F;
    bool is_ghost = false;
  };
  urban_nav_registration::CellTable table(sums_.size() / 4);
  std::vector<Block> blocks;
  std::vector<std::pair<std::size_t, std::uint32_t>> members;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const Sums& sums = sums_[i];
    if (!of_sensor(sums.sensor)) continue;
    const std::uint32_t number = table.insert(toKey({sums.cell.x >> 1, sums.cell.y >> 1, sums.cell.z >> 1}));
    if (number == blocks.size()) blocks.emplace_back();
    const Eigen::Vector3f corner(static_cast<float>(sums.cell.x - origin_cell_.x),
                                 static_cast<float>(sums.cell.y - origin_cell_.y),
                                 static_cast<float>(sums.cell.z - origin_cell_.z));
    blocks[number].sum += (corner + sums.offset / sums.weight) / per_m_;
    blocks[number].cubes += 1.0F;
    members.emplace_back(i, number);
  }
  for (Block& block : blocks) block.is_ghost = is_ghost((block.sum / block.cubes).cast<double>());
  for (const auto& [i, number] : members) sums_[i].is_ghost = blocks[number].is_ghost;
}

void ChunkGrid::appendTo(std::map<Tile, std::vector<MapCell>>& parts) const {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;  // keys are unique
  order.reserve(sums_.size());
  for (std::uint32_t i = 0; i < sums_.size(); ++i) order.emplace_back(orderKey(sums_[i].cell), i);
  std::sort(order.begin(), order.end());
  std::vector<MapCell>* part = nullptr;
  Tile tile;
  for (const auto& [key, i] : order) {
    const Tile own = tileAt(sums_[i].cell);
    if (part == nullptr || !(own == tile)) part = &parts[own];
    tile = own;
    part->push_back(mean(sums_[i]));
  }
}

MapCell ChunkGrid::mean(const Sums& sums) {
  const float share = 1.0F / sums.weight;
  MapCell cell;
  cell.cell = sums.cell;
  cell.count = static_cast<std::uint16_t>(std::min(sums.count, 65535));
  cell.laser = sums.sensor;
  cell.is_ghost = sums.is_ghost;
  cell.intensity = static_cast<std::uint8_t>(std::lround(std::clamp(share * sums.intensity, 0.0F, 255.0F)));
  cell.offset = share * sums.offset;
  cell.to_laser = share * sums.to_laser;
  cell.range = share * sums.range;
  cell.time_us = static_cast<std::int32_t>(sums.time / sums.points / 1000);
  return cell;
}

}  // namespace laser_mapper
