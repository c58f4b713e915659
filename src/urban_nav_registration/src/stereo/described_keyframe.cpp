// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/described_keyframe.hpp"

#include <algorithm>

#include "urban_nav_core/camera/surface.hpp"
#include "urban_nav_registration/io/jpeg.hpp"

namespace urban_nav_registration {

using urban_nav_core::StereoCamera;

namespace {

constexpr int kViewLevels = 6;  // levels of the pyramid: alignment uses 4, descriptors of near points more
// Side of a descriptor's window in the scene. Bench pairs, street: with 0.6, 0.9, 1.2, 1.8, 2.4 m, of pairs 4 to 7.5 m
// apart 72, 75, 78, 77, 75 % are upgraded.
constexpr double kWindowM = 1.2;
constexpr double kLargestWindow = 0.35;  // of the image's height

}  // namespace

View::View(const Keyframe& keyframe, const StereoCamera& camera) : at(keyframe.at), pyramid(kViewLevels) {
  const cv::Mat pixels = decodeJpeg(keyframe.image, {camera.left.width, camera.left.height});
  if (pixels.empty()) return;
  pyramid.build({pixels.data, pixels.cols, pixels.rows, static_cast<std::ptrdiff_t>(pixels.step)});
  points.reserve(keyframe.points.size());
  for (const KeyframePoint& from : keyframe.points) {
    if (from.level >= pyramid.levels()) continue;
    ViewPoint point;
    point.pixel = from.pixel();
    if (!camera.left.contains(point.pixel)) continue;
    point.level = from.level;
    point.ray = camera.left.ray(point.pixel);
    point.disparity = static_cast<double>(from.disparity);
    point.sigma_disparity = static_cast<double>(from.sigma_disparity);
    point.plane =
        urban_nav_core::surfaceThrough(camera, {point.pixel.x(), point.pixel.y(), point.pixel.x() - point.disparity},
                                       {static_cast<double>(from.slope_u), static_cast<double>(from.slope_v)});
    if (!point.plane.allFinite() || !(point.sigma_disparity > 0.0)) continue;
    points.push_back(point);
  }
  descriptors.resize(kDescriptorSize, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ViewPoint& point = points[i];
    const double px_per_m = std::max(0.0, point.disparity - camera.disparity_offset) / camera.baseline;
    const double window =
        std::clamp(kWindowM * px_per_m, kLeastWindowPx, std::max(kLeastWindowPx, kLargestWindow * camera.left.height));
    descriptors.col(static_cast<Eigen::Index>(i)) = describe(pyramid, point.pixel, window);
  }
}

}  // namespace urban_nav_registration
