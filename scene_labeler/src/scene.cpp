// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace scene_labeler {
namespace {

constexpr int depth_cell = 6;          // px: returns of a surface are nearer to each other than that in most images
constexpr float hidden_ratio = 1.1F;   // of depths: a surface seen at a grazing angle does not hide itself
constexpr float hidden_margin = 0.5F;  // m
constexpr float no_depth = std::numeric_limits<float>::infinity();

bool isInside(const SceneView& view, std::size_t i) {
  const Eigen::Vector2f& pixel = view.pixels[i];
  return view.depths[i] > 0.0F && pixel.x() >= 0.0F && pixel.y() >= 0.0F &&
         pixel.x() <= static_cast<float>(view.image.cols - 1) && pixel.y() <= static_cast<float>(view.image.rows - 1);
}

}  // namespace

void projectScene(const Eigen::Matrix<double, 3, 4>& projection, Scene& scene) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  scene.view.pixels.assign(scene.points.size(), {nan, nan});
  scene.view.depths.assign(scene.points.size(), 0.0F);
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    if (!scene.points[i].allFinite()) continue;
    const Eigen::Vector3d uvw = projection * scene.points[i].cast<double>().homogeneous();
    if (!(uvw.z() > 0.0)) continue;
    scene.view.pixels[i] = (uvw.head<2>() / uvw.z()).cast<float>();
    scene.view.depths[i] = static_cast<float>(uvw.z());
  }
}

bool isUsable(const cv::Mat& image) {
  constexpr int black = 8, saturated = 250;  // of 255, brightest channel
  constexpr int step = 7;                    // every 49th pixel is enough
  std::size_t seen = 0, usable = 0;
  for (int y = 0; y < image.rows; y += step)
    for (int x = 0; x < image.cols; x += step) {
      const cv::Vec3b& colour = image.at<cv::Vec3b>(y, x);
      const int brightest = std::max({colour[0], colour[1], colour[2]});
      ++seen;
      usable += brightest > black && brightest < saturated ? 1U : 0U;
    }
  return seen > 0 && 10 * usable >= seen;
}

std::vector<std::uint8_t> visibleReturns(const SceneView& view) {
  std::vector<std::uint8_t> visible(view.pixels.size(), 0);
  if (view.image.empty()) return visible;
  const int columns = view.image.cols / depth_cell + 1, rows = view.image.rows / depth_cell + 1;
  std::vector<float> nearest(static_cast<std::size_t>(columns * rows), no_depth);
  const auto cellAt = [columns](int x, int y) { return static_cast<std::size_t>(y * columns + x); };
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (!isInside(view, i)) continue;
    float& depth = nearest[cellAt(static_cast<int>(view.pixels[i].x()) / depth_cell,
                                  static_cast<int>(view.pixels[i].y()) / depth_cell)];
    depth = std::min(depth, view.depths[i]);
  }
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (!isInside(view, i)) continue;
    const int x = static_cast<int>(view.pixels[i].x()) / depth_cell,
              y = static_cast<int>(view.pixels[i].y()) / depth_cell;
    float depth = no_depth;
    for (int v = std::max(0, y - 1); v <= std::min(rows - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(columns - 1, x + 1); ++u)
        depth = std::min(depth, nearest[cellAt(u, v)]);
    visible[i] = view.depths[i] <= hidden_ratio * depth + hidden_margin ? 1 : 0;
  }
  return visible;
}

}  // namespace scene_labeler
