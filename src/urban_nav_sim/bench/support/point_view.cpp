// SPDX-License-Identifier: BSD-3-Clause
#include "point_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace urban_nav_sim::bench {
namespace {

constexpr int kPointViewScale = 2;
constexpr double kSize = 0.025;    // m, half the side of the square of a point
constexpr float kDarkness = 1.5F;  // of edges
const cv::Vec3b kBackground(36, 28, 24);

struct Drawn {
  cv::Mat depth, height, reflectance;  // m; depth is infinite without a point
};

Drawn drawn(const std::vector<Return>& cloud, const FreeCamera& camera) {
  const Lens lens = camera.lens(kPointViewScale);
  const urban_nav_core::Pose T_camera_world = camera.place().inverse();
  Drawn d{cv::Mat(lens.height, lens.width, CV_32F, std::numeric_limits<float>::infinity()),
          cv::Mat(lens.height, lens.width, CV_32F, 0.0F), cv::Mat(lens.height, lens.width, CV_32F, 0.0F)};
  for (const auto& [p, reflectance] : cloud) {
    const Eigen::Vector3d p_cam = T_camera_world * Eigen::Vector3d(p.cast<double>());
    const auto pixel = lens.project(p_cam);
    if (!pixel) continue;
    const auto depth = static_cast<float>(p_cam.z());
    const int reach = static_cast<int>(std::lround(std::clamp(kSize * lens.fx / p_cam.z(), 0.5, 6.0)));
    const int u0 = static_cast<int>(std::lround(pixel->x())), v0 = static_cast<int>(std::lround(pixel->y()));
    for (int v = std::max(v0 - reach, 0); v <= std::min(v0 + reach, lens.height - 1); ++v) {
      for (int u = std::max(u0 - reach, 0); u <= std::min(u0 + reach, lens.width - 1); ++u) {
        if (d.depth.at<float>(v, u) <= depth) continue;
        d.depth.at<float>(v, u) = depth;
        d.height.at<float>(v, u) = p.z();
        d.reflectance.at<float>(v, u) = reflectance;
      }
    }
  }
  return d;
}

/// Returns the brightness factor of a pixel next to nearer ones.
float lightAt(const cv::Mat& depth, int u, int v) {
  constexpr std::array<std::array<int, 2>, 8> kAround = {
      {{3, 0}, {-3, 0}, {0, 3}, {0, -3}, {2, 2}, {-2, 2}, {2, -2}, {-2, -2}}};
  const float here = depth.at<float>(v, u);
  float sum = 0.0F;
  for (const auto& [du, dv] : kAround) {
    const float there = depth.at<float>(std::clamp(v + dv, 0, depth.rows - 1), std::clamp(u + du, 0, depth.cols - 1));
    if (std::isfinite(there)) sum += std::max(0.0F, std::log2(here / there));
  }
  return std::exp(-kDarkness * sum);
}

}  // namespace

cv::Mat drawCloud(const std::vector<Return>& cloud, const FreeCamera& camera, float top) {
  const Drawn d = drawn(cloud, camera);
  cv::Mat levels, image;
  d.height.convertTo(levels, CV_8U, 195.0 / static_cast<double>(top), 35.0);
  cv::applyColorMap(levels, image, cv::COLORMAP_TURBO);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      auto& pixel = image.at<cv::Vec3b>(v, u);
      if (!std::isfinite(d.depth.at<float>(v, u))) {
        pixel = kBackground;
        continue;
      }
      const float bright = std::clamp(0.35F + d.reflectance.at<float>(v, u) / 110.0F, 0.0F, 1.0F);
      pixel *= bright * (0.2F + 0.8F * lightAt(d.depth, u, v));
    }
  }
  cv::Mat result;
  cv::resize(image, result, cv::Size(camera.width, camera.height), 0.0, 0.0, cv::INTER_AREA);
  return result;
}

}  // namespace urban_nav_sim::bench
