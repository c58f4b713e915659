// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/numbers.hpp"

namespace laser_mapper {

using urban_nav_core::Vector3d;

namespace {

constexpr std::uint16_t kFewestPoints = 2;  // per obstacle
constexpr double kBeamStep = 0.7;           // of a cell
constexpr double kBelowGround = 0.3;        // m: lower beams were reflected, or the ground is wrong
constexpr std::uint8_t kObstacle = 0, kFree = 254, kUnknown = 205;

}  // namespace

/// Marks the cells in which a beam was too low over the ground for an obstacle to be there, except the last one.
void OccupancyGrid::followBeam(const Vector3d& from, const Vector3d& to) {
  const Vector3d along = to - from;
  const double length = along.head<2>().norm(), step = kBeamStep * ground_.model().resolution;
  const auto last = ground_.index(to.x(), to.y());
  for (double s = 0.0; s < length; s += step) {
    const Vector3d p = from + (s / length) * along;
    const auto at = ground_.index(p.x(), p.y());
    if (!at || at == last) continue;
    const double above = p.z() - static_cast<double>(ground_.ground(*at));
    if (above < ground_.model().robot_height && above > -kBelowGround) cells_[*at].passed = true;
  }
}

void OccupancyGrid::addBeams(const std::vector<MapPoint>& points, const BeamOrigin& origin) {
  for (const MapPoint& point : points) {
    const auto at = ground_.index(point.p.x(), point.p.y());
    if (!at) continue;
    Cell& cell = cells_[*at];
    const float above = point.p.z() - ground_.groundAround(*at);
    if (static_cast<double>(above) <= ground_.model().obstacle_height) {
      cell.passed = true;
    } else if (static_cast<double>(point.p.z() - ground_.ground(*at)) <= ground_.model().robot_height) {
      cell.obstacles = static_cast<std::uint16_t>(std::min(65535, cell.obstacles + 1));
    }
    if (const auto from = origin(point)) followBeam(*from, point.p.cast<double>());
  }
}

OccupancyGrid::State OccupancyGrid::state(std::size_t cell) const {
  if (ground_.isDriven(cell)) return State::Free;
  if (cells_[cell].obstacles >= kFewestPoints) return State::Obstacle;
  return cells_[cell].passed ? State::Free : State::Unknown;
}

std::vector<std::uint8_t> OccupancyGrid::image() const {
  std::vector<std::uint8_t> image;
  image.reserve(cells_.size());
  for (int v = ground_.height() - 1; v >= 0; --v)
    for (int u = 0; u < ground_.width(); ++u) {
      const State cell =
          state(static_cast<std::size_t>(v) * static_cast<std::size_t>(ground_.width()) + static_cast<std::size_t>(u));
      image.push_back(cell == State::Obstacle ? kObstacle : cell == State::Free ? kFree : kUnknown);
    }
  return image;
}

GridPlacement localPlacement(const GroundGrid& ground) {
  return {ground.model().resolution, ground.x0(), ground.y0(), 0.0};
}

std::string printPgm(const std::vector<std::uint8_t>& image, int width, int height) {
  std::string bytes = "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  bytes.append(image.begin(), image.end());
  return bytes;
}

std::string printGridYaml(const GridPlacement& placement, const std::string& image) {
  using urban_nav_core::printNumber;
  return "image: " + image + "\nresolution: " + printNumber(placement.resolution) + "\norigin: [" +
         printNumber(placement.x) + ", " + printNumber(placement.y) + ", " + printNumber(placement.yaw) +
         "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

}  // namespace laser_mapper
