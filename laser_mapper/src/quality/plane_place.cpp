// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/plane_place.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "quality/pass_blocks.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace laser_mapper {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kLeastApart = 20'000'000'000;  // between passes: nearer ones share the error of their poses
constexpr std::size_t kFewestCells = 40;
constexpr float kMostBeams = 4.0F;           // largest number of beams of a cell that reduces its noise: the rest are
                                             // errors of poses
constexpr double kCapture = 0.5;             // m along the normal
constexpr double kModeBin = 0.02;            // m
constexpr double kPatchReachAtFirst = 0.06;  // m about the mode of the distances
constexpr double kPatchReach = 0.03;         // m about the previously fitted plane
constexpr double kMostThickness = 0.015;     // m: walls, paving and mown grass, but not hedges
constexpr double kLeastPatchExtent = 0.25;   // relative to the radius, standard deviation in the shorter direction
constexpr double kLeastShare = 0.7;          // of the cells around the centre on the plane
constexpr double kMostTurn = 0.35;           // rad from the normal of the first pass
constexpr double kSteep = 0.3, kFlat = 0.85;

/// Plane and the side from which it was observed.
struct PatchFit {
  PlanePatch patch;
  double extent = 0.0;  ///< m, standard deviation in the shorter direction
};

std::optional<PatchFit> fitPatch(std::uint16_t pass, const std::vector<PlacedCell>& cells) {
  if (cells.size() < kFewestCells) return std::nullopt;
  PatchFit fit;
  Vector3d to_laser = Vector3d::Zero();
  std::map<std::uint8_t, double> lasers;
  double weight = 0.0, seconds = 0.0, squares = 0.0;
  const StampNs since = cells.front().cell->stamp;
  for (const PlacedCell& placed : cells) {
    const double w = static_cast<double>(std::min(placed.cell->count, kMostBeams));
    weight += w;
    fit.patch.centre += w * placed.p;
    to_laser += w * placed.cell->to_laser.cast<double>();
    lasers[placed.cell->laser] += w;
    const double t = urban_nav_core::secondsBetween(since, placed.cell->stamp);
    seconds += w * t;
    squares += w * t * t;
  }
  fit.patch.centre /= weight;
  const double mean = seconds / weight;
  for (const PlacedCell& placed : cells) {
    const Vector3d d = placed.p - fit.patch.centre;
    const double share = static_cast<double>(std::min(placed.cell->count, kMostBeams)) / weight;
    fit.patch.scatter += share * d * d.transpose();
    fit.patch.sweep += share * (urban_nav_core::secondsBetween(since, placed.cell->stamp) - mean) * d;
  }
  const auto eigen = urban_nav_core::smallEigen<3>(fit.patch.scatter);
  fit.patch.normal = eigen.vectors.col(0);
  if (fit.patch.normal.dot(to_laser) < 0.0) fit.patch.normal = -fit.patch.normal;
  fit.patch.facing = fit.patch.normal.dot(to_laser) / weight;
  fit.patch.laser = std::max_element(lasers.begin(), lasers.end(), [](const auto& a, const auto& b) {
                      return a.second < b.second;
                    })->first;
  fit.patch.thickness = std::sqrt(std::max(0.0, eigen.values(0)));
  fit.extent = std::sqrt(std::max(0.0, eigen.values(1)));
  fit.patch.pass = pass;
  fit.patch.cells = cells.size();
  fit.patch.session = cells.front().cell->session;
  fit.patch.stamp = since + std::llround(1e9 * mean);
  fit.patch.stamp_spread = std::sqrt(std::max(0.0, squares / weight - mean * mean));
  return fit;
}

bool isPatch(const PatchFit& fit, double radius) {
  return fit.patch.thickness < kMostThickness && fit.extent > kLeastPatchExtent * radius &&
         fit.patch.normal.allFinite();
}

/// Returns the mode of the distances of cells along the normal.
double mostFrequentDistance(const PlanePatch& about, const std::vector<PlacedCell>& cells) {
  const int bins = 2 * static_cast<int>(kCapture / kModeBin) + 1;
  std::vector<int> counts(static_cast<std::size_t>(bins) + 2, 0);
  for (const PlacedCell& placed : cells) {
    const double d = about.normal.dot(placed.p - about.centre) + kCapture;
    ++counts[static_cast<std::size_t>(std::clamp(static_cast<int>(d / kModeBin), 0, bins - 1)) + 1];
  }
  std::size_t best = 1;
  int most = -1;
  for (std::size_t i = 1; i + 1 < counts.size(); ++i)
    if (const int sum = counts[i - 1] + 2 * counts[i] + counts[i + 1]; sum > most) {
      most = sum;
      best = i;
    }
  return (static_cast<double>(best - 1) + 0.5) * kModeBin - kCapture;
}

std::vector<PlacedCell> cellsNearPlane(const std::vector<PlacedCell>& cells, const Vector3d& centre,
                                       const Vector3d& normal, double reach) {
  std::vector<PlacedCell> near;
  for (const PlacedCell& placed : cells)
    if (std::abs(normal.dot(placed.p - centre)) < reach) near.push_back(placed);
  return near;
}

/// Returns the plane of a pass around the place defined by `seed`.
std::optional<PlanePatch> measurePatch(const PassBlocks& blocks, const PlanePatch& seed, double radius) {
  const std::vector<PlacedCell> around = blocks.around(seed.centre, seed.normal, radius, kCapture);
  if (around.size() < kFewestCells) return std::nullopt;
  Vector3d centre = seed.centre + mostFrequentDistance(seed, around) * seed.normal, normal = seed.normal;
  std::optional<PatchFit> fit;
  for (const double reach : {kPatchReachAtFirst, kPatchReach, kPatchReach}) {
    fit = fitPatch(blocks.pass(), cellsNearPlane(around, centre, normal, reach));
    if (!fit || fit->patch.normal.dot(seed.normal) < std::cos(kMostTurn)) return std::nullopt;
    centre = fit->patch.centre;
    normal = fit->patch.normal;
  }
  if (!isPatch(*fit, radius) ||
      static_cast<double>(fit->patch.cells) < kLeastShare * static_cast<double>(around.size()))
    return std::nullopt;
  const double noise = fit->patch.thickness / std::sqrt(static_cast<double>(fit->patch.cells));
  fit->patch.displacement_sigma = noise;
  fit->patch.angle_sigma = noise / fit->extent;
  return fit->patch;
}

void comparePatches(PlanePlace& place, double range_bias) {
  Matrix3d scatter = Matrix3d::Zero();
  double angle_variance = 0.0, variance = 0.0;
  for (const PlanePatch& patch : place.patches) {
    place.centre += patch.centre / static_cast<double>(place.patches.size());
    scatter += patch.scatter;
  }
  place.normal = urban_nav_core::smallEigen<3>(scatter).vectors.col(0);
  if (place.normal.dot(place.patches.front().normal) < 0.0) place.normal = -place.normal;
  for (std::size_t a = 0; a < place.patches.size(); ++a)
    for (std::size_t b = a + 1; b < place.patches.size(); ++b) {
      const PlanePatch &first = place.patches[a], &second = place.patches[b];
      if (std::abs(second.stamp - first.stamp) < kLeastApart) continue;
      const Vector3d normal = (first.normal + second.normal).normalized();
      place.pairs.push_back({a, b,
                             std::atan2(first.normal.cross(second.normal).norm(), first.normal.dot(second.normal)),
                             std::abs(normal.dot(second.centre - first.centre))});
      place.angle += place.pairs.back().angle;
      place.displacement += place.pairs.back().displacement;
      angle_variance += first.angle_sigma * first.angle_sigma + second.angle_sigma * second.angle_sigma;
      variance += first.displacement_sigma * first.displacement_sigma +
                  second.displacement_sigma * second.displacement_sigma + 2.0 * range_bias * range_bias;
    }
  if (place.pairs.empty()) return;
  const auto pairs = static_cast<double>(place.pairs.size());
  const double independent = static_cast<double>(place.patches.size() - 1);
  place.angle /= pairs;
  place.displacement /= pairs;
  place.angle_sigma = std::sqrt(angle_variance / (pairs * independent));
  place.displacement_sigma = std::sqrt(variance / (pairs * independent));
}

}  // namespace

bool PlanePlace::isWall() const { return std::abs(normal.z()) < kSteep; }
bool PlanePlace::isGround() const { return std::abs(normal.z()) > kFlat; }

std::vector<PlanePlace> findPlanePlaces(double voxel, double range_bias, const std::vector<PassCells>& passes) {
  const double radius = kPlaceRadius * voxel;
  std::vector<PassBlocks> all;
  all.reserve(passes.size());
  for (const PassCells& pass : passes) all.emplace_back(voxel, pass);
  std::vector<PlanePlace> places;
  urban_nav_registration::CellTable taken(1 << 10);  // blocks that already have a place
  for (std::size_t s = 0; s + 1 < all.size(); ++s)
    for (const PassBlocks::Block& block : all[s].blocks()) {
      if (taken.find(block.key) != urban_nav_registration::CellTable::kNone) continue;
      const std::optional<PatchFit> seed = fitPatch(all[s].pass(), block.cells);
      if (!seed || !isPatch(*seed, radius)) continue;
      PlanePlace place;
      for (std::size_t other = s; other < all.size(); ++other)
        if (auto patch = measurePatch(all[other], seed->patch, radius)) place.patches.push_back(*patch);
      if (place.patches.size() < 2) continue;
      comparePatches(place, range_bias);
      if (place.pairs.empty()) continue;
      taken.insert(block.key);
      places.push_back(std::move(place));
    }
  return places;
}

}  // namespace laser_mapper
