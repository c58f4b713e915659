// SPDX-License-Identifier: BSD-3-Clause
#include "topics/stereo/disparity_picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace urban_nav {

using dense_stereo::DensePoint;
using dense_stereo::DisparityImage;
using dense_stereo::NearScene;

namespace {

constexpr double kGroundBand = 0.08;  // m, about the plane

std::uint8_t toLevel(float value, float most) {
  return static_cast<std::uint8_t>(std::clamp(255.0F * value / most, 0.0F, 255.0F));
}

/// `levels` in colours, black where there is no disparity.
cv::Mat coloured(const DisparityImage& image, const cv::Mat& levels, int colour_map) {
  cv::Mat colours;
  cv::applyColorMap(levels, colours, colour_map);
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u)
      if (!image.isValid(u, v)) colours.at<cv::Vec3b>(v, u) = {0, 0, 0};
  return colours;
}

void mark(cv::Mat& picture, int u, int v, const cv::Vec3b& colour) {
  for (int y = v; y < std::min(v + NearScene::kStep, picture.rows); ++y)
    for (int x = u; x < std::min(u + NearScene::kStep, picture.cols); ++x) {
      cv::Vec3b& pixel = picture.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>((pixel[c] + colour[c]) / 2);
    }
}

}  // namespace

cv::Mat drawDisparities(const DisparityImage& image, float most) {
  if (most <= 0.0F) most = std::max(*std::max_element(image.disparity.begin(), image.disparity.end()), 1.0F);
  cv::Mat levels(image.height, image.width, CV_8UC1);
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u)
      levels.at<std::uint8_t>(v, u) = toLevel(image.disparity[image.index(u, v)], most);
  return coloured(image, levels, cv::COLORMAP_JET);
}

cv::Mat drawDeviations(const DisparityImage& image, float most) {
  cv::Mat levels(image.height, image.width, CV_8UC1);
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u)
      levels.at<std::uint8_t>(v, u) = toLevel(std::sqrt(image.variance[image.index(u, v)]), most);
  return coloured(image, levels, cv::COLORMAP_VIRIDIS);
}

cv::Mat drawGround(const NearScene& scene, const urban_nav_core::ImageView& left,
                   const urban_nav_core::StereoCamera& camera) {
  cv::Mat picture(left.height, left.width, CV_8UC3);
  for (int v = 0; v < left.height; ++v)
    for (int u = 0; u < left.width; ++u) picture.at<cv::Vec3b>(v, u) = cv::Vec3b::all(left.at(u, v));
  if (scene.ground.isFound())
    for (const DensePoint& point : scene.points)
      if (std::abs(heightAbove(scene.ground, point.p_cam)) < kGroundBand)
        mark(picture, point.u, point.v, {60, 200, 60});
  for (const dense_stereo::ObstaclePoint& obstacle : scene.obstacles) {
    const Eigen::Vector3f& p = obstacle.p_cam;
    const double u = camera.left.fx * static_cast<double>(p.x() / p.z()) + camera.left.cx;
    const double v = camera.left.fy * static_cast<double>(p.y() / p.z()) + camera.left.cy;
    mark(picture, std::max(0, static_cast<int>(std::lround(u))), std::max(0, static_cast<int>(std::lround(v))),
         {40, 40, 240});
  }
  return picture;
}

}  // namespace urban_nav
