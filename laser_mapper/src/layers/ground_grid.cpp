// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/layers/ground_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace laser_mapper {

using urban_nav_core::Vector3d;

namespace {

constexpr float kUnreached = 1e9F;
constexpr float kLargestStep = 0.25F;    // m of ground height between adjacent cells
constexpr int kAround = 2;               // cells whose lowest ground is the base of an obstacle
constexpr std::size_t kErroneous = 2;    // cells around a cell whose lowest point may be below the ground by an error
constexpr float kSteepestGround = 0.7F;  // z of a unit normal: 45 deg

}  // namespace

GroundGrid::GroundGrid(const GridModel& model, const std::vector<Vector3d>& path) : model_(model), path_(path) {
  Vector3d low = Vector3d::Zero(), high = Vector3d::Zero();
  for (std::size_t i = 0; i < path.size(); ++i) {
    low = i == 0 ? path[i] : Vector3d(low.cwiseMin(path[i]));
    high = i == 0 ? path[i] : Vector3d(high.cwiseMax(path[i]));
  }
  const double edge = model.resolution;
  x0_ = edge * std::floor((low.x() - model.margin) / edge);
  y0_ = edge * std::floor((low.y() - model.margin) / edge);
  width_ = static_cast<int>(std::ceil((high.x() + model.margin - x0_) / edge));
  height_ = static_cast<int>(std::ceil((high.y() + model.margin - y0_) / edge));
  cells_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  markDriven();
}

std::optional<std::size_t> GroundGrid::index(double x, double y) const {
  const double u = std::floor((x - x0_) / model_.resolution), v = std::floor((y - y0_) / model_.resolution);
  if (!(u >= 0.0 && v >= 0.0 && u < width_ && v < height_)) return std::nullopt;
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
}

void GroundGrid::markDriven() {
  const int reach = static_cast<int>(std::ceil(model_.robot_radius / model_.resolution));
  for (const Vector3d& p : path_)
    for (int dv = -reach; dv <= reach; ++dv)
      for (int du = -reach; du <= reach; ++du) {
        const double dx = du * model_.resolution, dy = dv * model_.resolution;
        if (std::hypot(dx, dy) > model_.robot_radius) continue;
        const auto at = index(p.x() + dx, p.y() + dy);
        if (!at) continue;
        cells_[*at].driven = true;
        cells_[*at].ground = std::min(cells_[*at].ground, static_cast<float>(p.z()));
      }
}

void GroundGrid::addSurface(const std::vector<MapPoint>& points) {
  for (const MapPoint& point : points)
    if (const auto at = index(point.p.x(), point.p.y())) cells_[*at].low = std::min(cells_[*at].low, point.p.z());
}

/// Lowers the path to the ground: base_link may be above it, such as the camera of a folder without extrinsics.
void GroundGrid::lowerPath() {
  std::vector<float> below;
  for (const Cell& cell : cells_)
    if (cell.ground != kUnreached && cell.low != kUnreached) below.push_back(cell.low - cell.ground);
  if (below.empty()) return;
  const auto middle = below.begin() + static_cast<std::ptrdiff_t>(below.size() / 2);
  std::nth_element(below.begin(), middle, below.end());
  if (*middle > -kLargestStep) return;
  for (Cell& cell : cells_)
    if (cell.ground != kUnreached) cell.ground += *middle;
}

/// Breadth-first from the path. A cell whose lowest point is within a step of the adjacent ground is ground; any other
/// cell inherits that ground, which continues below walls, overhangs and unobserved areas.
void GroundGrid::find() {
  lowerPath();
  std::vector<std::size_t> front, next;
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (cells_[i].ground != kUnreached) front.push_back(i);
  const auto row = static_cast<std::size_t>(width_);
  while (!front.empty()) {
    for (const std::size_t i : front) {
      const std::size_t u = i % row;
      for (const std::size_t j : {u > 0 ? i - 1 : i, u + 1 < row ? i + 1 : i, i >= row ? i - row : i,
                                  i + row < cells_.size() ? i + row : i}) {
        Cell& cell = cells_[j];
        if (cell.ground != kUnreached) continue;
        const float adjacent = cells_[i].ground;
        cell.ground = std::abs(cell.low - adjacent) <= kLargestStep ? cell.low : adjacent;
        next.push_back(j);
      }
    }
    front.swap(next);
    next.clear();
  }
}

float GroundGrid::groundAround(std::size_t cell) const {
  const auto u = static_cast<int>(cell % static_cast<std::size_t>(width_));
  const auto v = static_cast<int>(cell / static_cast<std::size_t>(width_));
  std::array<float, kErroneous + 1> lowest;  // ascending
  lowest.fill(kUnreached);
  for (int y = std::max(0, v - kAround); y <= std::min(height_ - 1, v + kAround); ++y)
    for (int x = std::max(0, u - kAround); x <= std::min(width_ - 1, u + kAround); ++x) {
      float ground =
          cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)].ground;
      for (float& each : lowest)
        if (ground < each) std::swap(ground, each);
    }
  return lowest.back();
}

std::optional<float> GroundGrid::lowest(std::size_t cell) const {
  return cells_[cell].low == kUnreached ? std::nullopt : std::optional<float>(cells_[cell].low);
}

bool GroundGrid::isGround(const MapPoint& point) const {
  const auto at = index(point.p.x(), point.p.y());
  if (!at) return false;
  const bool is_steep = point.normal.squaredNorm() > 0.5F && std::abs(point.normal.z()) < kSteepestGround;
  const Cell& cell = cells_[*at];  // along the path the ground is that of the robot, not that of the points
  const float ground = std::abs(cell.low - cell.ground) <= kLargestStep ? cell.low : cell.ground;
  return !is_steep && std::abs(point.p.z() - ground) <= static_cast<float>(model_.resolution);
}

}  // namespace laser_mapper
