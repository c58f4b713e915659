// SPDX-License-Identifier: BSD-3-Clause
#include "icp/residual_ratio.hpp"

#include <array>
#include <cmath>

#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_registration {

using urban_nav_core::PointCloud;

RobustScale computeResidualScale(const std::vector<Match>& matches) {
  std::vector<Match> upright = matches;
  for (Match& match : upright)
    if (std::abs(match.target_normal.z()) >= 0.5) match.weight = 0.0;
  return {computeSpread(matches), computeSpread(upright)};
}

RobustScale cloudNoise(const PointCloud& cloud, float voxel) {
  std::array<Surfels, 2> halves;
  urban_nav_core::forEach(2, 1, [&](std::size_t half) {
    PointCloud points;
    points.points.reserve(cloud.points.size() / 2 + 1);
    for (std::size_t i = half; i < cloud.points.size(); i += 2) points.points.push_back(cloud.points[i]);
    halves[half] = makeSurfels(points, voxel);
  });
  std::vector<Match> matches;
  const SurfelIndex index(halves[1].all, 2.0F * voxel);
  Matcher(halves[0].all, index).match({}, matches);
  return computeResidualScale(matches);
}

}  // namespace urban_nav_registration
