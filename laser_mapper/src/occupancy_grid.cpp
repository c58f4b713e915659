// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/numbers.hpp"

namespace laser_mapper {

using urban_nav_core::Vector3d;

namespace {

constexpr float kUnreached = 1e9F;
constexpr float kLargestStep = 0.25F;       // m of ground height between adjacent cells
constexpr int kAround = 2;                  // cells whose lowest ground is the base of an obstacle
constexpr std::uint16_t kFewestPoints = 2;  // per obstacle
constexpr double kBeamStep = 0.7;           // of a cell
constexpr double kBelowGround = 0.3;        // m: lower beams were reflected, or the ground is wrong
constexpr std::uint8_t kObstacle = 0, kFree = 254, kUnknown = 205;

}  // namespace

OccupancyGrid::OccupancyGrid(const GridModel& model, const std::vector<Vector3d>& path) : model_(model), path_(path) {
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

std::optional<std::size_t> OccupancyGrid::index(double x, double y) const {
  const double u = std::floor((x - x0_) / model_.resolution), v = std::floor((y - y0_) / model_.resolution);
  if (!(u >= 0.0 && v >= 0.0 && u < width_ && v < height_)) return std::nullopt;
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
}

void OccupancyGrid::markDriven() {
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

void OccupancyGrid::addSurface(const std::vector<MapPoint>& points) {
  for (const MapPoint& point : points)
    if (const auto at = index(point.p.x(), point.p.y())) cells_[*at].low = std::min(cells_[*at].low, point.p.z());
}

/// Lowers the path to the ground: base_link may be above it, such as the camera of a folder without extrinsics.
void OccupancyGrid::lowerPath() {
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
void OccupancyGrid::findGround() {
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
        const float beside = cells_[i].ground;
        cell.ground = std::abs(cell.low - beside) <= kLargestStep ? cell.low : beside;
        next.push_back(j);
      }
    }
    front.swap(next);
    next.clear();
  }
}

float OccupancyGrid::groundAround(std::size_t cell) const {
  const auto u = static_cast<int>(cell % static_cast<std::size_t>(width_));
  const auto v = static_cast<int>(cell / static_cast<std::size_t>(width_));
  float lowest = kUnreached;
  for (int y = std::max(0, v - kAround); y <= std::min(height_ - 1, v + kAround); ++y)
    for (int x = std::max(0, u - kAround); x <= std::min(width_ - 1, u + kAround); ++x)
      lowest = std::min(
          lowest,
          cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)].ground);
  return lowest;
}

/// Marks the cells in which a beam was too low over the ground for an obstacle to be there, except the last one.
void OccupancyGrid::followBeam(const Vector3d& from, const Vector3d& to) {
  const Vector3d along = to - from;
  const double length = along.head<2>().norm(), step = kBeamStep * model_.resolution;
  const auto last = index(to.x(), to.y());
  for (double s = 0.0; s < length; s += step) {
    const Vector3d p = from + (s / length) * along;
    const auto at = index(p.x(), p.y());
    if (!at || at == last) continue;
    const double above = p.z() - static_cast<double>(cells_[*at].ground);
    if (above < model_.robot_height && above > -kBelowGround) cells_[*at].passed = true;
  }
}

void OccupancyGrid::addBeams(const std::vector<MapPoint>& points, const BeamOrigin& origin) {
  for (const MapPoint& point : points) {
    const auto at = index(point.p.x(), point.p.y());
    if (!at) continue;
    Cell& cell = cells_[*at];
    const float above = point.p.z() - groundAround(*at);
    if (static_cast<double>(above) <= model_.obstacle_height) {
      cell.passed = true;
    } else if (static_cast<double>(point.p.z() - cell.ground) <= model_.robot_height) {
      cell.obstacles = static_cast<std::uint16_t>(std::min(65535, cell.obstacles + 1));
    }
    if (const auto from = origin(point)) followBeam(*from, point.p.cast<double>());
  }
}

std::vector<std::uint8_t> OccupancyGrid::image() const {
  std::vector<std::uint8_t> image;
  image.reserve(cells_.size());
  for (int v = height_ - 1; v >= 0; --v)
    for (int u = 0; u < width_; ++u) {
      const Cell& cell =
          cells_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u)];
      if (cell.obstacles >= kFewestPoints && !cell.driven) image.push_back(kObstacle);
      else image.push_back(cell.passed || cell.driven ? kFree : kUnknown);
    }
  return image;
}

std::string printPgm(const std::vector<std::uint8_t>& image, int width, int height) {
  std::string bytes = "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  bytes.append(image.begin(), image.end());
  return bytes;
}

std::string printGridYaml(const OccupancyGrid& grid, const GridModel& model, const std::string& image) {
  using urban_nav_core::printNumber;
  return "image: " + image + "\nresolution: " + printNumber(model.resolution) + "\norigin: [" + printNumber(grid.x0()) +
         ", " + printNumber(grid.y0()) + ", 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

}  // namespace laser_mapper
