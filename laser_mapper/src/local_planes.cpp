// SPDX-License-Identifier: BSD-3-Clause
#include "local_planes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace laser_mapper {

using Eigen::Matrix3f;
using Eigen::Vector3f;
using urban_nav_registration::keyBeside;
using urban_nav_registration::toKey;

namespace {

constexpr float kMaxWeight = 16.0F;    // beams: a voxel near a standing robot must not dominate its neighbours
constexpr float kLeastExtent = 0.15F;  // squared edges: variance in the plane's shorter direction, 0.75 if it is fully
                                       // covered
constexpr int kLeastCubes = 3;
constexpr float kMaxFlatness = 0.3F;  // ratio of thickness to the shorter extent, beyond which there is no plane

int coarse(int value, int level) { return value >> level; }  // rounds towards minus infinity

}  // namespace

void LocalPlanes::Moments::add(const Moments& other, const Vector3f& shift) {
  const Vector3f& s = shift;
  w += other.w;
  first += other.first + other.w * s;
  const Vector3f& f = other.first;
  second += other.second;
  second[0] += 2.0F * f.x() * s.x() + other.w * s.x() * s.x();
  second[1] += f.x() * s.y() + f.y() * s.x() + other.w * s.x() * s.y();
  second[2] += f.x() * s.z() + f.z() * s.x() + other.w * s.x() * s.z();
  second[3] += 2.0F * f.y() * s.y() + other.w * s.y() * s.y();
  second[4] += f.y() * s.z() + f.z() * s.y() + other.w * s.y() * s.z();
  second[5] += 2.0F * f.z() * s.z() + other.w * s.z() * s.z();
}

LocalPlanes::LocalPlanes(double voxel, const Tile& tile, const std::vector<MergedCell>& cells,
                         const std::vector<MergedCell>& margin)
    : voxel_(static_cast<float>(voxel)),
      corner_{tile.x * kTileCells, tile.y * kTileCells, 0},
      origin_(voxel * corner_.x, voxel * corner_.y, 0.0) {
  for (int level = 0; level < kLevels; ++level) {
    Level& at = levels_[static_cast<std::size_t>(level)];
    at.edge = voxel_ * static_cast<float>(1 << level);
    at.table = urban_nav_registration::CellTable((cells.size() + margin.size()) >> level);
    at.cubes.reserve((cells.size() + margin.size()) >> level);
  }
  counts_.reserve(cells.size() + margin.size());
  for (const std::vector<MergedCell>* part : {&cells, &margin})
    for (const MergedCell& cell : *part) addToLevels(cell);
}

void LocalPlanes::addToLevels(const MergedCell& cell) {
  const Cell at = local(cell.cell);
  const Vector3f corner(static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z));
  const float w = std::min(cell.count, kMaxWeight);
  for (int level = 0; level < kLevels; ++level) {
    Level& into = levels_[static_cast<std::size_t>(level)];
    const Cell cube{coarse(at.x, level), coarse(at.y, level), coarse(at.z, level)};
    const std::uint32_t number = into.table.insert(toKey(cube));
    if (number == into.cubes.size()) into.cubes.emplace_back();
    const auto size = static_cast<float>(1 << level);
    const Vector3f centre =
        size * (Vector3f(static_cast<float>(cube.x), static_cast<float>(cube.y), static_cast<float>(cube.z)) +
                Vector3f::Constant(0.5F));
    const Vector3f from_centre = voxel_ * (corner + cell.offset - centre);
    Moments own;
    own.w = w;
    into.cubes[number].add(own, from_centre);
    if (level == 0) counts_.push_back(cell.count);
  }
}

Vector3f LocalPlanes::position(const MergedCell& cell) const {
  const Cell at = local(cell.cell);
  return voxel_ *
         (Vector3f(static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)) + cell.offset);
}

std::optional<LocalPlane> LocalPlanes::fitPlane(int level, const Cell& cube) const {
  const Level& at = levels_[static_cast<std::size_t>(level)];
  const std::uint64_t key = toKey(cube);
  Moments sums;
  int cubes = 0;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const std::uint32_t number = at.table.find(keyBeside(key, {dx, dy, dz}));
        if (number == urban_nav_registration::CellTable::kNone) continue;
        sums.add(at.cubes[number],
                 at.edge * Vector3f(static_cast<float>(dx), static_cast<float>(dy), static_cast<float>(dz)));
        ++cubes;
      }
  if (cubes < kLeastCubes) return std::nullopt;
  const float share = 1.0F / sums.w;
  const Vector3f mean = share * sums.first;
  Matrix3f covariance;
  const auto& m = sums.second;
  covariance << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  covariance = share * covariance - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Matrix3f> eigen;
  eigen.computeDirect(covariance);
  const Vector3f& variance = eigen.eigenvalues();
  if (!(variance[1] > kLeastExtent * at.edge * at.edge)) return std::nullopt;
  LocalPlane plane;
  plane.level = level;
  plane.normal = eigen.eigenvectors().col(0);
  plane.thickness = std::sqrt(std::max(variance[0], 0.0F));
  if (!(plane.thickness * plane.thickness < kMaxFlatness * kMaxFlatness * variance[1])) return std::nullopt;
  plane.weight = sums.w;
  const Vector3f centre(static_cast<float>(cube.x) + 0.5F, static_cast<float>(cube.y) + 0.5F,
                        static_cast<float>(cube.z) + 0.5F);
  plane.centre = at.edge * centre + mean;
  if (!plane.normal.allFinite()) return std::nullopt;
  return plane;
}

/// All cells of a coarse cube share its plane: from the second level on it is fitted once for several cells.
std::optional<LocalPlane> LocalPlanes::planeAt(int level, const Cell& cell) {
  const Cell cube{coarse(cell.x, level), coarse(cell.y, level), coarse(cell.z, level)};
  if (level == 0) return fitPlane(level, cube);
  Level& at = levels_[static_cast<std::size_t>(level)];
  const std::uint32_t number = at.table.find(toKey(cube));
  if (number == urban_nav_registration::CellTable::kNone) return fitPlane(level, cube);
  if (at.plane_of.empty()) at.plane_of.assign(at.cubes.size(), kUnknown);
  std::int32_t& known = at.plane_of[number];
  if (known == kUnknown) {
    const std::optional<LocalPlane> plane = fitPlane(level, cube);
    known = plane ? static_cast<std::int32_t>(at.planes.size()) : kNone;
    if (plane) at.planes.push_back(*plane);
  }
  if (known == kNone) return std::nullopt;
  return at.planes[static_cast<std::size_t>(known)];
}

std::optional<LocalPlane> LocalPlanes::around(const MergedCell& cell) {
  const Cell at = local(cell.cell);
  for (int level = 0; level < kLevels; ++level)
    if (std::optional<LocalPlane> plane = planeAt(level, at)) return plane;
  return std::nullopt;
}

bool LocalPlanes::hasMoreBeams(const Cell& other, const MergedCell& cell) const {
  const std::uint32_t number = levels_[0].table.find(toKey(other));
  if (number == urban_nav_registration::CellTable::kNone) return false;
  return counts_[number] > cell.count || (counts_[number] == cell.count && toKey(other) < toKey(local(cell.cell)));
}

bool LocalPlanes::belongsToAnother(const MergedCell& cell, const Vector3f& position, const LocalPlane& plane,
                                   float reach) const {
  const Cell own = local(cell.cell);
  const Vector3f corner = (position / voxel_).array().floor();
  const Cell at{static_cast<int>(corner.x()), static_cast<int>(corner.y()), static_cast<int>(corner.z())};
  if ((at.x != own.x || at.y != own.y || at.z != own.z) && hasMoreBeams(at, cell)) return true;
  int axis = 0;
  plane.normal.cwiseAbs().maxCoeff(&axis);
  for (const int step : {-1, 1}) {
    const Cell beside{own.x + (axis == 0 ? step : 0), own.y + (axis == 1 ? step : 0), own.z + (axis == 2 ? step : 0)};
    const std::uint32_t number = levels_[0].table.find(toKey(beside));
    if (number == urban_nav_registration::CellTable::kNone || !hasMoreBeams(beside, cell)) continue;
    const Moments& moments = levels_[0].cubes[number];
    const Vector3f mean = voxel_ * Vector3f(static_cast<float>(beside.x) + 0.5F, static_cast<float>(beside.y) + 0.5F,
                                            static_cast<float>(beside.z) + 0.5F) +
                          moments.first / moments.w;
    if (std::abs(plane.normal.dot(mean - plane.centre)) < reach) return true;
  }
  return false;
}

}  // namespace laser_mapper
