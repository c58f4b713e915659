// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/layers/space_grid.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace laser_mapper {

using Eigen::Vector3d;

namespace {

constexpr double kOriginEdge = 0.5;  // m, of the cubes in which beams count as of one origin

SpaceGrid::Index blockNumbers(const SpaceGrid::Index& cube) {
  SpaceGrid::Index block{};
  for (std::size_t axis = 0; axis < 3; ++axis) block[axis] = cube[axis] >> 4;  // 16 cubes, rounded down
  return block;
}

SpaceGrid::Index cubeNumbers(const Vector3d& p, double edge) {
  SpaceGrid::Index index{};
  for (int axis = 0; axis < 3; ++axis)
    index[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(p(axis) / edge));
  return index;
}

}  // namespace

SpaceGrid::Index SpaceGrid::cubeAt(const Vector3d& p) const { return cubeNumbers(p, resolution_); }

SpaceGrid::Block& SpaceGrid::blockAt(const Index& cube) {
  const Index block = blockNumbers(cube);
  if (last_.second == nullptr || last_.first != block) last_ = {block, &blocks_[block]};
  return *last_.second;
}

SpaceState SpaceGrid::at(const Vector3d& p) const {
  const Index cube = cubeAt(p);
  const auto found = blocks_.find(blockNumbers(cube));
  return found == blocks_.end() ? SpaceState::Unknown : found->second.at(cube);
}

/// Visits the cubes along a beam in their order (Amanatides and Woo 1987), except the last one.
void SpaceGrid::followBeam(const Vector3d& from, const Vector3d& to) {
  Index at = cubeAt(from);
  const Index end = cubeAt(to);
  const Vector3d along = to - from;
  std::array<double, 3> next{}, step{};  // parts of the beam
  int cubes = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double d = along(static_cast<int>(axis)), p = from(static_cast<int>(axis));
    const double border = resolution_ * (at[axis] + (d > 0.0 ? 1 : 0));
    next[axis] = d == 0.0 ? std::numeric_limits<double>::infinity() : (border - p) / d;
    step[axis] = d == 0.0 ? 0.0 : resolution_ / std::abs(d);
    cubes += std::abs(end[axis] - at[axis]);
  }
  for (int i = 0; i < cubes && at != end; ++i) {
    Block& block = blockAt(at);
    if (block.at(at) == SpaceState::Unknown) block.set(at, SpaceState::Free);
    const std::size_t axis = next[0] <= next[1] && next[0] <= next[2] ? 0 : next[1] <= next[2] ? 1 : 2;
    at[axis] += along(static_cast<int>(axis)) > 0.0 ? 1 : -1;
    next[axis] += step[axis];
  }
}

void SpaceGrid::add(const std::vector<MapPoint>& points, const BeamOrigin& origin) {
  followed_.clear();
  for (const MapPoint& point : points) {
    const Vector3d to = point.p.cast<double>();
    const Index end = cubeAt(to);
    blockAt(end).set(end, SpaceState::Occupied);
    const auto from = origin(point);
    if (from && followed_.insert({end, cubeNumbers(*from, kOriginEdge)}).second) followBeam(*from, to);
  }
}

}  // namespace laser_mapper
