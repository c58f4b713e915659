// SPDX-License-Identifier: BSD-3-Clause
#include "surface_map.hpp"

#include <cmath>

namespace laser_odometry {

using urban_nav_registration::Cell;
using urban_nav_registration::CellTable;

namespace {

// Limit of the weight of a cube, so that it follows the newest sweeps: errors of old poses fade.
constexpr double kMostPoints = 2000.0;

Cell toCell(const Vector3d& p, double size) {
  const Vector3d c = (p / size).array().floor();
  return {static_cast<int>(c.x()), static_cast<int>(c.y()), static_cast<int>(c.z())};
}

Vector3d cubeCentre(const Vector3d& p, double size) { return ((p / size).array().floor() + 0.5) * size; }

}  // namespace

std::optional<std::uint64_t> findKey(const Vector3d& p, double size) {
  if (!(p.cwiseAbs().maxCoeff() < size * urban_nav_registration::kFarthestCell)) return std::nullopt;
  return urban_nav_registration::toKey(toCell(p, size));
}

const Plane& MapCell::currentPlane(MotionSpace space) {
  if (!is_current) plane = fit(space);
  is_current = true;
  return plane;
}

void MapCell::archive(urban_nav_core::Archive& archive) {
  archive(centre, moments, ring, first_sweep, last_sweep, residual, residual_sweep);
  archive.require(moments.count > 0.0, "cell without points");
  is_current = false;
}

SurfaceMap::SurfaceMap(double cell, int levels, double reach, MotionSpace space)
    : levels_(static_cast<std::size_t>(levels)), space_(space) {
  for (Level& level : levels_) {
    level.size = cell;
    level.reach = reach;
    cell *= 2.0;
    reach *= 2.0;
  }
}

std::size_t SurfaceMap::size() const {
  std::size_t size = 0;
  for (const Level& level : levels_) size += level.cells.size();
  return size;
}

void SurfaceMap::clear() {
  for (Level& level : levels_) {
    level.cells.clear();
    level.reindex();
  }
}

void SurfaceMap::Level::reindex() {
  table = CellTable(cells.size() + 64);
  for (const MapCell& cell : cells) table.insert(cell.key);
}

MapCell* SurfaceMap::Level::obtain(const Vector3d& p, std::int32_t sweep) {
  const std::optional<std::uint64_t> key = findKey(p, size);
  if (!key) return nullptr;
  const std::uint32_t number = table.insert(*key);
  if (number == cells.size()) {
    MapCell cell;
    cell.key = *key;
    cell.centre = cubeCentre(p, size);
    cell.first_sweep = sweep;
    cells.push_back(cell);
  }
  return &cells[number];
}

void SurfaceMap::insert(const std::vector<Segment>& segments, const Vector3d& origin, std::int32_t sweep) {
  // Segments of the sweep by smallest cubes, which are then added to the cubes of all levels: each segment is processed
  // once.
  std::vector<MapCell> parts;
  CellTable table(segments.size() / 2 + 64);
  const double size = levels_.front().size;
  for (const Segment& segment : segments) {
    const std::optional<std::uint64_t> key = findKey(segment.mean, size);
    if (!key) continue;
    const std::uint32_t number = table.insert(*key);
    if (number == parts.size()) {
      parts.emplace_back();
      parts.back().centre = cubeCentre(segment.mean, size);
    }
    MapCell& part = parts[number];
    part.moments.add(segment.count, segment.mean - part.centre, segment.covariance);
    part.addRing(segment.ring);
  }
  for (Level& level : levels_) {
    for (const MapCell& part : parts) {
      if ((part.centre - origin).squaredNorm() > level.reach * level.reach && &level != &levels_.back()) continue;
      MapCell* cell = level.obtain(part.centre, sweep);
      if (cell == nullptr) continue;
      cell->moments.add(part.moments, part.centre - cell->centre);
      cell->addRing(part.ring);
      if (cell->moments.count > kMostPoints) cell->moments.scale(0.5);
      cell->last_sweep = sweep;
      cell->is_current = false;
    }
  }
}

MapCell* SurfaceMap::find(const Vector3d& p, int level) {
  for (std::size_t i = static_cast<std::size_t>(level); i < levels_.size(); ++i) {
    const std::optional<std::uint64_t> key = findKey(p, levels_[i].size);
    if (!key) continue;
    const std::uint32_t number = levels_[i].table.find(*key);
    if (number == CellTable::kNone) continue;
    MapCell& cell = levels_[i].cells[number];
    if (cell.currentPlane(space_).usable && !isOutside(cell.plane, p)) return &cell;
  }
  return nullptr;
}

bool SurfaceMap::hasPlane(const MapCell& cell, int level) const {
  const Level& finer = levels_[static_cast<std::size_t>(level)];
  const std::optional<std::uint64_t> key = findKey(cell.centre + cell.moments.mean(), finer.size);
  if (!key) return false;
  const std::uint32_t number = finer.table.find(*key);
  if (number == CellTable::kNone) return false;
  return findPlane(finer.cells[number]).usable;
}

void SurfaceMap::prune(const Vector3d& p, double distance) {
  for (Level& level : levels_) {
    std::vector<MapCell> kept;
    for (MapCell& cell : level.cells)
      if ((cell.centre - p).squaredNorm() <= distance * distance) kept.push_back(cell);
    if (kept.size() == level.cells.size()) continue;
    level.cells = std::move(kept);
    level.reindex();
  }
}

void SurfaceMap::archive(urban_nav_core::Archive& archive) {
  for (Level& level : levels_) {
    archive(level.cells);
    if (!archive.isReading()) continue;
    for (MapCell& cell : level.cells) {
      const std::optional<std::uint64_t> key = findKey(cell.centre, level.size);
      archive.require(key && (cell.centre - cubeCentre(cell.centre, level.size)).norm() < 1e-3 * level.size,
                      "cell centre is not that of its cube");
      cell.key = *key;
    }
    level.reindex();
    archive.require(level.table.size() == level.cells.size(), "duplicate cell");
  }
}

}  // namespace laser_odometry
