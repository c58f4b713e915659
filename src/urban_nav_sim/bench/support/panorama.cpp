// SPDX-License-Identifier: BSD-3-Clause
#include "panorama.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace urban_nav_sim::bench {
namespace {

constexpr double kHalfHeight = 0.8;  // radii: at the seams the images end at 0.85
constexpr double kDistance = 8.0;    // m
constexpr double kFade = 12.0;       // px, from the side of an image to its full weight

/// Position of each pixel of the cylinder in an image, and its weight.
struct Mapped {
  cv::Mat u, v, weight;
};

Mapped mapped(const Camera& camera, int width, int height) {
  Mapped m{cv::Mat(height, width, CV_32F, -1.0F), cv::Mat(height, width, CV_32F, -1.0F),
           cv::Mat(height, width, CV_32F, 0.0F)};
  const urban_nav_core::Pose T_camera_head = camera.T_head_camera.inverse();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double azimuth = 2.0 * M_PI * (0.5 - (x + 0.5) / width),
                   rise = kHalfHeight * (1.0 - 2.0 * (y + 0.5) / height);
      const Eigen::Vector3d point = kDistance * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), rise);
      const auto pixel = camera.lens.project(T_camera_head * point);
      if (!pixel) continue;
      const double inside = std::min(pixel->x(), camera.lens.width - 1 - pixel->x());
      if (inside <= 0.0 || pixel->y() < 0.0 || pixel->y() > camera.lens.height - 1) continue;
      m.u.at<float>(y, x) = static_cast<float>(pixel->x());
      m.v.at<float>(y, x) = static_cast<float>(pixel->y());
      m.weight.at<float>(y, x) = static_cast<float>(std::min(inside / kFade, 1.0));
    }
  }
  return m;
}

}  // namespace

cv::Mat panorama(const std::array<Camera, 5>& cameras, const std::array<cv::Mat, 5>& images, int width) {
  const int height = static_cast<int>(std::lround(width * kHalfHeight / M_PI));
  cv::Mat sum(height, width, CV_32FC3, cv::Scalar::all(0.0)), weights(height, width, CV_32F, 1e-6F);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Mapped m = mapped(cameras[i], width, height);
    cv::Mat seen, weight;
    cv::remap(images[i], seen, m.u, m.v, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    seen.convertTo(seen, CV_32FC3);
    cv::merge(std::vector<cv::Mat>(3, m.weight), weight);
    sum += seen.mul(weight);
    weights += m.weight;
  }
  cv::Mat weight, result;
  cv::merge(std::vector<cv::Mat>(3, weights), weight);
  cv::Mat(sum / weight).convertTo(result, CV_8UC3);
  return result;
}

}  // namespace urban_nav_sim::bench
