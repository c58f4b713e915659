// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/keyframe/keyframe_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "urban_nav_registration/io/jpeg.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"

namespace urban_nav_registration {

using urban_nav_core::Matrix3d;
using urban_nav_core::Pinhole;
using urban_nav_core::Pose;

namespace {

constexpr int kConversionQuality = 95;     // JPEG quality: the image was compressed once before
constexpr int kLargestCoordinate = 32767;  // px: points are stored in 16 bits

cv::Matx33d toIntrinsics(const Pinhole& camera) {
  return {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
}

}  // namespace

KeyframeConversion::KeyframeConversion(const MountedCamera& from, const MountedCamera& to)
    : from_(from.camera),
      to_(to.camera),
      R_to_from_(to.T_base_left.R().transpose() * from.T_base_left.R()),
      T_base_virtual_(Eigen::Quaterniond::Identity(), from.T_base_left.t() - to.T_base_left.t()) {}

bool KeyframeConversion::convertPoint(const KeyframePoint& point, KeyframePoint& result) const {
  const double per_depth = from_.left.fx * from_.baseline, its_per_depth = to_.left.fx * to_.baseline;
  const double disparity = static_cast<double>(point.disparity) - from_.disparity_offset;
  const Eigen::Vector3d ray = R_to_from_ * from_.left.ray(point.pixel());
  if (!(ray.z() > 0.1)) return false;
  const double rho = disparity / per_depth / ray.z();  // 1/m: inverse depth along the other optical axis
  const Eigen::Vector2d pixel(to_.left.fx * ray.x() / ray.z() + to_.left.cx,
                              to_.left.fy * ray.y() / ray.z() + to_.left.cy);
  result = point;
  const double size = 1 << point.level;
  const Eigen::Vector2d rounded = (pixel / size).array().round();
  if (!(rounded.minCoeff() >= 0.0) || !(rounded.maxCoeff() <= kLargestCoordinate)) return false;
  result.u = static_cast<std::int16_t>(rounded.x());
  result.v = static_cast<std::int16_t>(rounded.y());
  if (!to_.left.contains(result.pixel())) return false;
  // Depth at the rounded pixel, along the surface.
  const double scale = its_per_depth / per_depth;
  const double slope_u = scale * static_cast<double>(point.slope_u) * from_.left.fx / to_.left.fx;
  const double slope_v = scale * static_cast<double>(point.slope_v) * from_.left.fy / to_.left.fy;
  const Eigen::Vector2d moved = result.pixel() - pixel;
  result.slope_u = static_cast<float>(slope_u);
  result.slope_v = static_cast<float>(slope_v);
  result.disparity =
      static_cast<float>(its_per_depth * rho + to_.disparity_offset + slope_u * moved.x() + slope_v * moved.y());
  result.sigma_disparity = static_cast<float>(scale * static_cast<double>(point.sigma_disparity) / ray.z());
  return std::isfinite(result.disparity) && result.sigma_disparity > 0.0F;
}

Keyframe KeyframeConversion::convert(const Keyframe& keyframe) const {
  Keyframe result;
  result.at = keyframe.at;
  result.width = to_.left.width;
  result.height = to_.left.height;
  const cv::Mat pixels = decodeJpeg(keyframe.image, {from_.left.width, from_.left.height});
  if (pixels.empty()) return result;
  cv::Matx33d rotation;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation(row, column) = R_to_from_(row, column);
  const cv::Matx33d homography = toIntrinsics(to_.left) * rotation * toIntrinsics(from_.left).inv();
  cv::Mat seen;
  cv::warpPerspective(pixels, seen, homography, {result.width, result.height}, cv::INTER_LINEAR);
  result.image =
      encodeJpeg({seen.data, seen.cols, seen.rows, static_cast<std::ptrdiff_t>(seen.step)}, kConversionQuality);
  result.points.reserve(keyframe.points.size());
  for (const KeyframePoint& point : keyframe.points) {
    KeyframePoint converted;
    if (convertPoint(point, converted)) result.points.push_back(converted);
  }
  return result;
}

std::shared_ptr<const KeyframeConversion> findConversion(const std::string& fingerprint, const MountedCamera& to,
                                                         bool& is_known) {
  is_known = true;
  if (isSameCalibration(fingerprint, calibrationFingerprint(to.camera, to.T_base_left))) return nullptr;
  const std::optional<MountedCamera> from = parseCalibrationFingerprint(fingerprint);
  is_known = from.has_value();
  return from ? std::make_shared<const KeyframeConversion>(*from, to) : nullptr;
}

}  // namespace urban_nav_registration
