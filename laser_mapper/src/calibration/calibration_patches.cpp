// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/calibration_patches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace laser_mapper {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using urban_nav_registration::Cell;
using urban_nav_registration::CellTable;

namespace {

constexpr double kBlock = 0.8;  // m
constexpr std::uint32_t kFewestSurfelBeams = 12;
constexpr double kMostSurfelThickness = 0.015;  // m: walls, paving and mown grass, as in the map quality
constexpr double kLeastSurfelExtent = 0.1;      // m, standard deviation in the shorter direction
constexpr double kAside = 0.6;                  // m
constexpr double kMostSurfelTurn = 0.35;        // rad between normals
constexpr double kHeldOutEdge = 4.0;            // m, of the squares that are held out as a whole
constexpr int kHeldOutShare = 5;                // one of this many

Cell blockAt(const Vector3d& p) {
  const auto part = [](double value) { return static_cast<int>(std::floor(value / kBlock)); };
  return {part(p.x()), part(p.y()), part(p.z())};
}

/// Beams that ended in one block.
struct BlockBeams {
  std::uint64_t key = 0;
  std::vector<std::uint32_t> beams;
};

/// Scans first...last - 1 of one laser in one window.
struct Window {
  std::size_t first = 0, last = 0;
};

std::vector<Window> divideIntoWindows(const SampledScans& samples) {
  std::vector<Window> windows;
  for (std::size_t i = 0; i < samples.scans.size(); ++i) {
    const SampledScans::Scan& scan = samples.scans[i];
    const bool continues =
        !windows.empty() && samples.scans[i - 1].window == scan.window && samples.scans[i - 1].laser == scan.laser;
    if (!continues) windows.push_back({i, i});
    windows.back().last = i + 1;
  }
  return windows;
}

std::vector<BlockBeams> divideIntoBlocks(const SampledScans& samples, const std::vector<ScanPlace>& places,
                                         const Window& window) {
  CellTable table(1 << 9);
  std::vector<BlockBeams> blocks;
  for (std::size_t s = window.first; s < window.last; ++s) {
    if (!places[s].is_known) continue;
    for (std::uint32_t beam = samples.scans[s].first; beam < samples.scans[s].last; ++beam) {
      const Cell cell = blockAt(places[s].inMap(samples.beams[beam]));
      if (std::max({std::abs(cell.x), std::abs(cell.y), std::abs(cell.z)}) > urban_nav_registration::kFarthestCell)
        continue;
      const std::uint64_t key = toKey(cell);
      const std::uint32_t number = table.insert(key);
      if (number == blocks.size()) blocks.push_back({key, {}});
      blocks[number].beams.push_back(beam);
    }
  }
  return blocks;
}

/// Fits the plane of a surfel's beams; returns their standard deviation in the shorter direction, m.
double fitSurfel(const SampledScans& samples, const std::vector<ScanPlace>& places,
                 const std::vector<std::uint32_t>& beams, CalibrationSurfel& surfel) {
  Vector3d reference = Vector3d::Zero(), first = Vector3d::Zero(), from_laser = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  double count = 0.0;
  for (std::uint32_t i = surfel.first; i < surfel.last; ++i) {
    const SampledScans::Beam& beam = samples.beams[beams[i]];
    const ScanPlace& place = places[beam.scan];
    if (!place.is_known) continue;
    const Vector3d p = place.inMap(beam);
    if (count == 0.0) reference = p;
    const Vector3d d = p - reference;
    count += 1.0;
    first += d;
    second += d * d.transpose();
    from_laser += p - (place.base + place.lever);
  }
  if (count == 0.0) return 0.0;
  const Vector3d mean = first / count;
  const auto eigen = urban_nav_core::smallEigen<3>(Matrix3d(second / count - mean * mean.transpose()));
  surfel.centre = reference + mean;
  surfel.normal = eigen.vectors.col(0);
  if (surfel.normal.dot(from_laser) > 0.0) surfel.normal = -surfel.normal;
  surfel.thickness = std::sqrt(std::max(0.0, eigen.values(0)));
  return std::sqrt(std::max(0.0, eigen.values(1)));
}

SurfelSet surfelsOfWindow(const SampledScans& samples, const std::vector<ScanPlace>& places, const Window& window) {
  SurfelSet set;
  for (const BlockBeams& block : divideIntoBlocks(samples, places, window)) {
    if (block.beams.size() < kFewestSurfelBeams) continue;
    CalibrationSurfel surfel;
    surfel.block = block.key;
    surfel.window = samples.scans[window.first].window;
    surfel.laser = samples.scans[window.first].laser;
    surfel.last = static_cast<std::uint32_t>(block.beams.size());
    const double extent = fitSurfel(samples, places, block.beams, surfel);
    if (surfel.thickness > kMostSurfelThickness || extent < kLeastSurfelExtent) continue;
    surfel.first += static_cast<std::uint32_t>(set.beams.size());
    surfel.last += static_cast<std::uint32_t>(set.beams.size());
    set.beams.insert(set.beams.end(), block.beams.begin(), block.beams.end());
    set.surfels.push_back(surfel);
  }
  return set;
}

bool isHeldOut(const Vector3d& p) {
  const auto part = [](double value) {
    return static_cast<std::uint64_t>(std::llround(std::floor(value / kHeldOutEdge)));
  };
  const std::uint64_t hash = (part(p.x()) * 0x9e3779b97f4a7c15U) ^ (part(p.y()) * 0xc2b2ae3d27d4eb4fU);
  return ((hash ^ (hash >> 29U)) * 0xbf58476d1ce4e5b9U >> 33U) % kHeldOutShare == 0;
}

/// Index of surfels by block.
class SurfelIndex {
 public:
  explicit SurfelIndex(const std::vector<CalibrationSurfel>& surfels) : table_(surfels.size()) {
    for (std::uint32_t i = 0; i < surfels.size(); ++i) {
      const std::uint32_t number = table_.insert(surfels[i].block);
      if (number == lists_.size()) lists_.emplace_back();
      lists_[number].push_back(i);
    }
  }
  template <typename Take>
  void forEachNeighbour(std::uint64_t block, const Take& take) const {
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const std::uint32_t number = table_.find(urban_nav_registration::keyBeside(block, {dx, dy, dz}));
          if (number == CellTable::kNone) continue;
          for (const std::uint32_t i : lists_[number]) take(i);
        }
  }

 private:
  CellTable table_;
  std::vector<std::vector<std::uint32_t>> lists_;
};

bool isOnPlane(const CalibrationSurfel& seed, const CalibrationSurfel& other, double reach) {
  if (seed.normal.dot(other.normal) < std::cos(kMostSurfelTurn)) return false;
  const Vector3d d = other.centre - seed.centre;
  const double across = seed.normal.dot(d);
  return std::abs(across) < reach && (d - across * seed.normal).squaredNorm() < kAside * kAside;
}

}  // namespace

SurfelSet findSurfels(const SampledScans& samples, const std::vector<ScanPlace>& places) {
  const std::vector<Window> windows = divideIntoWindows(samples);
  std::vector<SurfelSet> sets(windows.size());
  urban_nav_core::forEach(windows.size(), 1,
                          [&](std::size_t i) { sets[i] = surfelsOfWindow(samples, places, windows[i]); });
  SurfelSet all;
  for (const SurfelSet& set : sets) {
    const auto offset = static_cast<std::uint32_t>(all.beams.size());
    all.beams.insert(all.beams.end(), set.beams.begin(), set.beams.end());
    for (CalibrationSurfel surfel : set.surfels) {
      surfel.first += offset;
      surfel.last += offset;
      all.surfels.push_back(surfel);
    }
  }
  return all;
}

void moveSurfels(const SampledScans& samples, const std::vector<ScanPlace>& places, SurfelSet& set) {
  for (CalibrationSurfel& surfel : set.surfels) fitSurfel(samples, places, set.beams, surfel);
}

void updatePatch(const std::vector<CalibrationSurfel>& surfels, CalibrationPatch& patch) {
  patch.centre.setZero();
  patch.normal.setZero();
  for (const std::uint32_t i : patch.surfels) {
    patch.centre += surfels[i].centre / static_cast<double>(patch.surfels.size());
    patch.normal += surfels[i].beams() * surfels[i].normal;
  }
  patch.normal.normalize();
}

std::vector<CalibrationPatch> matchSurfels(const std::vector<CalibrationSurfel>& surfels, double reach) {
  const SurfelIndex index(surfels);
  std::vector<std::uint8_t> taken(surfels.size(), 0);
  std::vector<CalibrationPatch> patches;
  for (std::uint32_t seed = 0; seed < surfels.size(); ++seed) {
    if (taken[seed] != 0) continue;
    CalibrationPatch patch;
    index.forEachNeighbour(surfels[seed].block, [&](std::uint32_t i) {
      if (taken[i] == 0 && isOnPlane(surfels[seed], surfels[i], reach)) patch.surfels.push_back(i);
    });
    if (patch.surfels.size() < 2) continue;
    std::sort(patch.surfels.begin(), patch.surfels.end());
    for (const std::uint32_t i : patch.surfels) taken[i] = 1;
    updatePatch(surfels, patch);
    patch.is_held_out = isHeldOut(surfels[seed].centre);
    patches.push_back(std::move(patch));
  }
  return patches;
}

std::vector<double> surfelOffsets(const CalibrationPatch& patch, const std::vector<CalibrationSurfel>& surfels) {
  std::vector<double> offsets;
  std::vector<std::pair<double, std::uint32_t>> sorted;
  std::uint32_t beams = 0;
  for (const std::uint32_t i : patch.surfels) {
    offsets.push_back(patch.normal.dot(surfels[i].centre - patch.centre));
    sorted.emplace_back(offsets.back(), surfels[i].beams());
    beams += surfels[i].beams();
  }
  std::sort(sorted.begin(), sorted.end());
  std::uint32_t below = 0;
  double median = 0.0;
  for (const auto& [offset, weight] : sorted) {
    median = offset;
    below += weight;
    if (2 * below >= beams) break;
  }
  for (double& offset : offsets) offset -= median;
  return offsets;
}

}  // namespace laser_mapper
