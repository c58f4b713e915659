// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/cloud/surfels.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::PointCloud;

/// Sums over the points of a cube, relative to its lower corner, so that single precision is sufficient.
struct Moments {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, count = 0;
  Cell cell;
};

Eigen::Vector3f cellCorner(const Cell& cell) {
  return {static_cast<float>(cell.x), static_cast<float>(cell.y), static_cast<float>(cell.z)};
}

/// Changes the reference of the sums to a corner lower by d.
inline void shiftBy(Moments& cube, const Eigen::Vector3f& d) {
  const Eigen::Vector3f nd = cube.count * d, s = cube.sum;
  cube.xx += (2.0F * s.x() + nd.x()) * d.x();
  cube.yy += (2.0F * s.y() + nd.y()) * d.y();
  cube.zz += (2.0F * s.z() + nd.z()) * d.z();
  cube.xy += s.x() * d.y() + s.y() * d.x() + nd.x() * d.y();
  cube.xz += s.x() * d.z() + s.z() * d.x() + nd.x() * d.z();
  cube.yz += s.y() * d.z() + s.z() * d.y() + nd.y() * d.z();
  cube.sum += nd;
}

inline void addTo(Moments& sum, const Moments& cube) {
  sum.sum += cube.sum;
  sum.xx += cube.xx;
  sum.xy += cube.xy;
  sum.xz += cube.xz;
  sum.yy += cube.yy;
  sum.yz += cube.yz;
  sum.zz += cube.zz;
  sum.count += cube.count;
}

constexpr float kLeastExtent = 0.04F;  // variance, in edges squared: a standard deviation of a fifth of the edge

bool isWithin(const Eigen::Vector3f& point, float limit) {
  return std::abs(point.x()) < limit && std::abs(point.y()) < limit && std::abs(point.z()) < limit;  // false for NaN
}

struct SurfelGrid {
  CellTable table;
  std::vector<Moments> cubes;
  std::size_t used = 0;
};

SurfelGrid makeGrid(const PointCloud& cloud, float voxel) {
  SurfelGrid grid{CellTable(cloud.points.size() / 32 + 16), {}, 0};  // small: neighbours are looked up 27 at a time
  grid.cubes.reserve(cloud.points.size() / 8 + 16);
  const float per_m = 1.0F / voxel, limit = voxel * static_cast<float>(kFarthestCell);
  std::uint64_t last = 0;
  std::uint32_t number = CellTable::kNone;
  for (const Eigen::Vector3f& point : cloud.points) {
    if (!isWithin(point, limit)) continue;
    ++grid.used;
    const Cell cell = toCell(point, per_m);
    if (const std::uint64_t key = toKey(cell); key != last) {  // adjacent beams mostly share a cube
      number = grid.table.insert(key);
      last = key;
    }
    if (number == grid.cubes.size()) {
      grid.cubes.emplace_back();
      grid.cubes.back().cell = cell;
    }
    Moments& cube = grid.cubes[number];
    const Eigen::Vector3f d = point - voxel * cellCorner(cell);
    cube.sum += d;
    cube.xx += d.x() * d.x();
    cube.xy += d.x() * d.y();
    cube.xz += d.x() * d.z();
    cube.yy += d.y() * d.y();
    cube.yz += d.y() * d.z();
    cube.zz += d.z() * d.z();
    cube.count += 1.0F;
  }
  // From sums to means: each cube has equal weight in its neighbours' normals, independent of its number of beams.
  for (Moments& cube : grid.cubes) {
    const float share = 1.0F / cube.count;
    cube.sum *= share;
    for (float* moment : {&cube.xx, &cube.xy, &cube.xz, &cube.yy, &cube.yz, &cube.zz}) *moment *= share;
    cube.count = 1.0F;
  }
  return grid;
}

struct Coarser {
  SurfelGrid grid;
  std::vector<std::uint32_t> cube_of;  // index of the coarse cube, per cube of the finer grid
};

/// Returns the points in cubes of twice the edge; each of the eight sub-cubes is weighted by its number of occupied
/// voxels.
Coarser coarsen(const SurfelGrid& fine, float edge) {
  Coarser coarser{{CellTable(fine.cubes.size() / 4 + 16), {}, fine.used}, {}};
  SurfelGrid& grid = coarser.grid;
  grid.cubes.reserve(fine.cubes.size() / 2 + 16);
  coarser.cube_of.reserve(fine.cubes.size());
  for (const Moments& cube : fine.cubes) {
    const Cell cell{cube.cell.x >> 1, cube.cell.y >> 1, cube.cell.z >> 1};
    const std::uint32_t number = grid.table.insert(toKey(cell));
    coarser.cube_of.push_back(number);
    if (number == grid.cubes.size()) {
      grid.cubes.emplace_back();
      grid.cubes.back().cell = cell;
    }
    Moments shifted = cube;
    shiftBy(shifted, edge * cellCorner({cube.cell.x & 1, cube.cell.y & 1, cube.cell.z & 1}));
    addTo(grid.cubes[number], shifted);
  }
  return coarser;
}

/// A cube with its key, for ordering along x, then y, then z.
struct Placed {
  std::uint64_t key;
  std::uint32_t number;
};

std::vector<Placed> inOrder(const SurfelGrid& grid) {
  std::vector<Placed> placed(grid.cubes.size());
  for (std::uint32_t i = 0; i < placed.size(); ++i) placed[i] = {toKey(grid.cubes[i].cell), i};
  std::sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.key < b.key; });
  return placed;
}

/// Iterates over cubes in the order of their keys and, in parallel, over the nine rows of neighbours: the 26 neighbours
/// of a cube are found without look-ups.
class VoxelNeighbours {
 public:
  VoxelNeighbours(const SurfelGrid& grid, const std::vector<Placed>& placed, float edge)
      : grid_(grid), placed_(placed), edge_(edge) {}

  /// Returns the moments of the cube and its neighbours relative to the cube's corner. Requires keys in increasing
  /// order.
  Moments around(std::uint64_t key) {
    Moments all;
    std::size_t row = 0;
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j, ++row) {
        const std::uint64_t first = keyBeside(key, {-1, j, k}), last = first + 2;
        std::size_t& at = rows_[row];
        if (!begun_) at = firstFrom(first);
        while (at < placed_.size() && placed_[at].key < first) ++at;
        for (std::size_t next = at; next < placed_.size() && placed_[next].key <= last; ++next) {
          Moments cube = grid_.cubes[placed_[next].number];
          const int i = static_cast<int>(placed_[next].key - first) - 1;
          shiftBy(cube, edge_ * cellCorner({i, j, k}));
          addTo(all, cube);
        }
      }
    begun_ = true;
    return all;
  }

 private:
  std::size_t firstFrom(std::uint64_t key) const {
    const auto isBefore = [](const Placed& placed, std::uint64_t other) { return placed.key < other; };
    return static_cast<std::size_t>(std::lower_bound(placed_.begin(), placed_.end(), key, isBefore) - placed_.begin());
  }

  const SurfelGrid& grid_;
  const std::vector<Placed>& placed_;
  float edge_;
  bool begun_ = false;
  std::array<std::size_t, 9> rows_{};  // first neighbours of the last cube in `placed_`
};

/// Plane through the points of a cube and its 26 neighbours; negative planarity: no surface at this scale.
struct LocalPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float planarity = -1.0F;
};

LocalPlane fitLocalPlane(const Moments& all, float edge, const Eigen::Matrix3f& flat) {
  if (all.count < 3.0F) return {};
  const float share = 1.0F / all.count;
  const Eigen::Vector3f mean = share * all.sum;
  Eigen::Matrix3f covariance;
  covariance << all.xx, all.xy, all.xz, all.xy, all.yy, all.yz, all.xz, all.yz, all.zz;
  covariance = share * covariance - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> eigen;
  eigen.computeDirect(covariance + edge * edge * flat);
  const Eigen::Vector3f& variance = eigen.eigenvalues();
  // A surface extends beyond a part of its cube in both directions; a single ring of a laser on the ground does not.
  if (!(variance[1] > kLeastExtent * edge * edge)) return {};
  return {eigen.eigenvectors().col(0), std::max(0.0F, 1.0F - std::max(variance[0], 0.0F) / variance[1])};
}

/// Computes the planes of all wanted cubes of a grid, in the order of the grid.
std::vector<LocalPlane> fitLocalPlanes(const SurfelGrid& grid, const std::vector<std::uint8_t>& wanted, float edge,
                                       const Eigen::Matrix3f& flat) {
  constexpr std::size_t kRun = 512;
  const std::vector<Placed> placed = inOrder(grid);
  std::vector<LocalPlane> planes(placed.size());
  urban_nav_core::forEach((placed.size() + kRun - 1) / kRun, 1, [&](std::size_t run) {
    VoxelNeighbours neighbours(grid, placed, edge);
    for (std::size_t i = run * kRun; i < std::min(placed.size(), (run + 1) * kRun); ++i)
      if (wanted[placed[i].number] != 0)
        planes[placed[i].number] = fitLocalPlane(neighbours.around(placed[i].key), edge, flat);
  });
  return planes;
}

constexpr int kScales = 4;  // cubes of 1, 2, 4, 8 voxels: far from the sensor its beams are metres apart

/// Returns the normal of the plane if all points and the sensor lie in one plane, to a hundredth of the voxel.
/// A plane below the sensor is ground.
std::optional<Eigen::Vector3f> findScanPlane(const SurfelGrid& grid, float voxel) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d outer = Eigen::Matrix3d::Zero();
  for (const Moments& cube : grid.cubes) {
    const Eigen::Vector3d mean = (voxel * cellCorner(cube.cell) + cube.sum / cube.count).cast<double>();
    sum += mean;
    outer += mean * mean.transpose();
  }
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(grid.cubes.size(), 1));
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(share * outer - share * share * sum * sum.transpose());
  const double square = static_cast<double>(voxel * voxel);
  if (!(eigen.eigenvalues()[0] < 1e-4 * square) || !(eigen.eigenvalues()[1] > square)) return std::nullopt;
  if (std::abs(share * sum.dot(eigen.eigenvectors().col(0))) > 0.5 * static_cast<double>(voxel)) return std::nullopt;
  return eigen.eigenvectors().col(0).cast<float>();
}

}  // namespace

Surfels makeSurfels(const PointCloud& cloud, float voxel) {
  SurfelGrid grid = makeGrid(cloud, voxel);
  Surfels surfels;
  surfels.scan_plane = findScanPlane(grid, voxel);
  Eigen::Matrix3f flat = Eigen::Matrix3f::Zero();  // added to covariances: extent of walls that a planar scan does not
                                                   // measure
  if (surfels.scan_plane) flat = *surfels.scan_plane * surfels.scan_plane->transpose();
  surfels.voxel = voxel;
  surfels.points = grid.used;
  surfels.left_out = cloud.points.size() - surfels.points;
  surfels.all.resize(grid.cubes.size());
  for (std::size_t i = 0; i < grid.cubes.size(); ++i) {
    const Moments& own = grid.cubes[i];
    surfels.all[i].mean = voxel * cellCorner(own.cell) + own.sum / own.count;
    surfels.all[i].normal = Eigen::Vector3f::UnitZ();
  }
  std::vector<std::uint32_t> open(grid.cubes.size());  // surfels without a normal so far
  std::iota(open.begin(), open.end(), 0U);
  std::vector<std::uint32_t> cube_of = open;  // index of each surfel in the grid of the scale
  for (int scale = 0; scale < kScales && !open.empty(); ++scale) {
    const float edge = voxel * static_cast<float>(1 << scale);
    if (scale > 0) {
      Coarser coarser = coarsen(grid, 0.5F * edge);
      for (const std::uint32_t i : open) cube_of[i] = coarser.cube_of[cube_of[i]];
      grid = std::move(coarser.grid);
    }
    std::vector<std::uint8_t> wanted(grid.cubes.size(), 0);
    for (const std::uint32_t i : open) wanted[cube_of[i]] = 1;
    const std::vector<LocalPlane> planes = fitLocalPlanes(grid, wanted, edge, flat);
    std::vector<std::uint32_t> still_open;
    for (const std::uint32_t i : open) {
      const LocalPlane& local_plane = planes[cube_of[i]];
      if (local_plane.planarity < 0.0F) {
        still_open.push_back(i);
        continue;
      }
      Surfel& surfel = surfels.all[i];
      surfel.normal =
          local_plane.normal.dot(surfel.mean) > 0.0F ? Eigen::Vector3f(-local_plane.normal) : local_plane.normal;
      surfel.planarity = local_plane.planarity;
    }
    open = std::move(still_open);
  }
  return surfels;
}

}  // namespace urban_nav_registration
