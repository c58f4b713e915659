// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/near_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace dense_stereo {

namespace {

constexpr double kDisparityError = 0.1, kDepthError = 0.05;  // px, m

ObstacleOptions toObstacleOptions(const Parameters& parameters) {
  ObstacleOptions options;
  options.least_height = parameters.obstacle_height;
  options.clearance = parameters.clearance;
  return options;
}

double nearShare(const DisparityImage& image, std::size_t points) {
  std::size_t answered = 0;
  for (int v = 0; v < image.height; v += NearScene::kStep)
    for (int u = 0; u < image.width; u += NearScene::kStep) answered += image.isValid(u, v) ? 1 : 0;
  return answered == 0 ? 0.0 : static_cast<double>(points) / static_cast<double>(answered);
}

/// Returns the number of the cube that contains a point: 21 bits per axis.
std::uint64_t cubeNumber(const Eigen::Vector3f& p, double spacing) {
  std::uint64_t number = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::int64_t>(std::floor(static_cast<double>(p[axis]) / spacing));
    number = number << 21U | (static_cast<std::uint64_t>(cell) & 0x1fffffU);
  }
  return number;
}

/// Returns the standard deviation of the depth, up to a common factor.
double depthSigma(const DensePoint& point) {
  return std::sqrt(static_cast<double>(point.variance)) * static_cast<double>(point.p_cam.z()) /
         static_cast<double>(point.disparity);
}

}  // namespace

double rangeLimit(double max_range, const urban_nav_core::StereoCamera& camera) {
  return std::max(max_range, std::sqrt(kDepthError / kDisparityError * camera.left.fx * camera.baseline));
}

NearSceneEstimator::NearSceneEstimator(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
                                       std::unique_ptr<Matcher> matcher)
    : camera_(camera),
      range_(rangeLimit(parameters.max_range, camera)),
      obstacles_(toObstacleOptions(parameters)),
      stereo_(parameters, std::move(matcher)) {}

const NearScene& NearSceneEstimator::process(const urban_nav_core::StereoPair& pair,
                                             const std::optional<Eigen::Vector3d>& up) {
  scene_.stereo = stereo_.process(pair);
  scene_.points = makePoints(scene_.stereo.image, camera_, range_, NearScene::kStep);
  scene_.near_share = nearShare(scene_.stereo.image, scene_.points.size());
  GroundOptions options;
  options.up = up;
  scene_.ground = findGround(scene_.points, camera_, options);
  scene_.obstacles = findObstacles(scene_.points, NearScene::kStep, scene_.ground, obstacles_);
  return scene_;
}

std::vector<DensePoint> thinPoints(const std::vector<DensePoint>& points, double spacing) {
  std::unordered_map<std::uint64_t, std::size_t> best;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [cube, is_new] = best.emplace(cubeNumber(points[i].p_cam, spacing), i);
    if (!is_new && depthSigma(points[i]) < depthSigma(points[cube->second])) cube->second = i;
  }
  std::vector<std::size_t> kept;
  kept.reserve(best.size());
  for (const auto& [cube, i] : best) kept.push_back(i);
  std::sort(kept.begin(), kept.end());
  std::vector<DensePoint> thinned;
  thinned.reserve(kept.size());
  for (const std::size_t i : kept) thinned.push_back(points[i]);
  return thinned;
}

}  // namespace dense_stereo
