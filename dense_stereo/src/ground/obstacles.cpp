// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/obstacles.hpp"

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>

namespace dense_stereo {

namespace {

// Points on top of an object of exactly that height scatter around it.
constexpr double kHeightShare = 0.8;
constexpr double kSureDeviations = 2.0;

/// Two axes in the ground plane.
struct GroundAxes {
  Eigen::Vector3d forward, right;
  explicit GroundAxes(const Eigen::Vector3d& up) {
    forward = (Eigen::Vector3d::UnitZ() - up.z() * up).normalized();
    right = forward.cross(up);
  }
};

std::int64_t cellKey(std::int64_t x, std::int64_t y) { return x * 1000003 + y; }

}  // namespace

std::vector<ObstaclePoint> findObstacles(const std::vector<DensePoint>& points, int step, const GroundPlane& ground,
                                         const ObstacleOptions& options) {
  std::vector<ObstaclePoint> candidates;
  if (!ground.isFound()) return candidates;
  const GroundAxes axes(ground.up);
  const double threshold = kHeightShare * options.least_height;
  std::unordered_map<std::int64_t, int> counts;
  std::vector<std::pair<std::int64_t, std::int64_t>> cells;
  for (const DensePoint& point : points) {
    const double height = heightAbove(ground, point.p_cam);
    // A disparity error moves a point along its line of sight.
    const double sigma = std::sqrt(static_cast<double>(point.variance)) / static_cast<double>(point.disparity) *
                         std::abs(ground.up.dot(point.p_cam.cast<double>()));
    if (std::abs(height) < threshold + kSureDeviations * sigma || height > options.clearance) continue;
    const Eigen::Vector3d p = point.p_cam.cast<double>();
    const auto x = static_cast<std::int64_t>(std::floor(axes.forward.dot(p) / options.cell));
    const auto y = static_cast<std::int64_t>(std::floor(axes.right.dot(p) / options.cell));
    candidates.push_back({point.p_cam, static_cast<float>(height)});
    cells.emplace_back(x, y);
    ++counts[cellKey(x, y)];
  }
  const int least = std::max(options.least_pixels / (step * step), 3);
  std::vector<ObstaclePoint> obstacles;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    int support = 0;
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto cell = counts.find(cellKey(cells[i].first + dx, cells[i].second + dy));
        if (cell != counts.end()) support += cell->second;
      }
    if (support >= least) obstacles.push_back(candidates[i]);
  }
  return obstacles;
}

}  // namespace dense_stereo
