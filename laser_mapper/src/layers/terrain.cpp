// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/layers/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "urban_nav_core/parallel/for_each.hpp"

namespace laser_mapper {

namespace {

constexpr int kFewestHeights = 6;  // for a plane: twice its unknowns
constexpr double kLeastCellSpread =
    0.25;  // product of the eigenvalues of the positions over their mean squared; 0: on a line
constexpr double kSlopeDegrees = 180.0 / M_PI;

/// Cell within the radius, by its offset.
struct Neighbour {
  int du = 0, dv = 0;
};

std::vector<Neighbour> neighbours(double radius, double cell) {
  const int reach = static_cast<int>(std::ceil(radius / cell));
  std::vector<Neighbour> all;
  for (int dv = -reach; dv <= reach; ++dv)
    for (int du = -reach; du <= reach; ++du)
      if (std::hypot(du, dv) * cell <= radius) all.push_back({du, dv});
  return all;
}

/// Slope and residual of the least-squares plane through heights.
struct PlaneFit {
  double slope_deg = 0.0, residual = 0.0;  ///< residual: m, standard deviation
};

/// Sums over cells for the normal equations of a plane, relative to the cell in the middle.
struct PlaneSums {
  double n = 0.0, x = 0.0, y = 0.0, z = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, xz = 0.0, yz = 0.0, zz = 0.0;

  void add(double px, double py, double pz) {
    n += 1.0;
    x += px;
    y += py;
    z += pz;
    xx += px * px;
    xy += px * py;
    yy += py * py;
    xz += px * pz;
    yz += py * pz;
    zz += pz * pz;
  }

  /// Returns nullopt if the cells are too few, or on a line.
  std::optional<PlaneFit> fit() const {
    if (n < kFewestHeights) return std::nullopt;
    const double cxx = xx - x * x / n, cxy = xy - x * y / n, cyy = yy - y * y / n;
    const double cxz = xz - x * z / n, cyz = yz - y * z / n, czz = zz - z * z / n;
    const double determinant = cxx * cyy - cxy * cxy, mean = 0.5 * (cxx + cyy);
    if (!(determinant > kLeastCellSpread * mean * mean)) return std::nullopt;
    const double a = (cxz * cyy - cyz * cxy) / determinant, b = (cyz * cxx - cxz * cxy) / determinant;
    const double squares = std::max(0.0, czz - a * cxz - b * cyz);
    return PlaneFit{kSlopeDegrees * std::atan(std::hypot(a, b)), std::sqrt(squares / (n - 3.0))};
  }
};

/// Returns the largest difference in height of a cell to the next ones in the directions of the axes.
double stepAt(const Raster& elevation, int u, int v) {
  double largest = 0.0;
  const double z = static_cast<double>(elevation.values[elevation.at(u, v)]);
  for (const Neighbour& n : {Neighbour{1, 0}, Neighbour{-1, 0}, Neighbour{0, 1}, Neighbour{0, -1}})
    if (elevation.isKnown(u + n.du, v + n.dv))
      largest =
          std::max(largest, std::abs(static_cast<double>(elevation.values[elevation.at(u + n.du, v + n.dv)]) - z));
  return largest;
}

double computeTraversability(const PlaneFit& plane, double step, const TraversabilityModel& model) {
  double sum = 0.0;
  for (const auto& [value, limit] : {std::pair(plane.slope_deg, model.slope_limit), std::pair(step, model.step_limit),
                                     std::pair(plane.residual, model.roughness_limit)}) {
    if (!(value < limit)) return 0.0;
    sum += value / limit;
  }
  return 1.0 - sum / 3.0;
}

}  // namespace

TerrainLayers terrainLayers(const Raster& elevation, const TraversabilityModel& model, double scale) {
  const double cell = elevation.cell / scale;
  const std::vector<Neighbour> around = neighbours(model.radius, cell);
  TerrainLayers layers{emptyLike(elevation), emptyLike(elevation), emptyLike(elevation), emptyLike(elevation)};
  Raster steps = emptyLike(elevation);
  const auto forEachKnown = [&](auto&& take) {
    urban_nav_core::forEach(static_cast<std::size_t>(elevation.height), 16, [&](std::size_t row) {
      const int v = static_cast<int>(row);
      for (int u = 0; u < elevation.width; ++u)
        if (elevation.isKnown(u, v)) take(u, v);
    });
  };
  forEachKnown([&](int u, int v) { steps.values[steps.at(u, v)] = static_cast<float>(stepAt(elevation, u, v)); });
  forEachKnown([&](int u, int v) {
    PlaneSums sums;
    const std::size_t middle = elevation.at(u, v);
    double step = 0.0;
    for (const Neighbour& n : around) {
      if (!elevation.isKnown(u + n.du, v + n.dv)) continue;
      const std::size_t i = elevation.at(u + n.du, v + n.dv);
      sums.add(cell * n.du, cell * n.dv,
               static_cast<double>(elevation.values[i]) - static_cast<double>(elevation.values[middle]));
      step = std::max(step, static_cast<double>(steps.values[i]));
    }
    const auto plane = sums.fit();
    if (!plane) return;
    layers.slope.values[middle] = static_cast<float>(plane->slope_deg);
    layers.roughness.values[middle] = static_cast<float>(plane->residual);
    layers.step.values[middle] = static_cast<float>(step);
    layers.traversability.values[middle] = static_cast<float>(computeTraversability(*plane, step, model));
  });
  return layers;
}

}  // namespace laser_mapper
