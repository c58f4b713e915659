// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/points.hpp"

namespace dense_stereo {

using urban_nav_core::StereoCamera;

std::vector<DensePoint> makePoints(const DisparityImage& image, const StereoCamera& camera, double max_range,
                                   int step) {
  std::vector<DensePoint> points;
  const double focal = camera.left.fx * camera.baseline;
  for (int v = 0; v < image.height; v += step)
    for (int u = 0; u < image.width; u += step) {
      const std::size_t at = image.index(u, v);
      const double d = static_cast<double>(image.disparity[at]) - camera.disparity_offset;
      if (!image.isValid(u, v) || d <= 0.0) continue;
      const double z = focal / d;
      const Eigen::Vector3d p((u - camera.left.cx) / camera.left.fx * z, (v - camera.left.cy) / camera.left.fy * z, z);
      if (p.squaredNorm() > max_range * max_range) continue;
      points.push_back({u, v, static_cast<float>(d), image.variance[at], p.cast<float>()});
    }
  return points;
}

Eigen::Matrix3d pointCovariance(const DensePoint& point, const StereoCamera& camera) {
  constexpr double kDirectionVariance = 1.0 / 12.0;  // px^2, of a position within a pixel
  const Eigen::Vector3d p = point.p_cam.cast<double>();
  const double z = p.z(), d = static_cast<double>(point.disparity);
  const Eigen::Vector3d along = p / d;  // dp/dd is -p/d
  const double across_u = z / camera.left.fx, across_v = z / camera.left.fy;
  Eigen::Matrix3d covariance = along * along.transpose() * static_cast<double>(point.variance);
  covariance(0, 0) += across_u * across_u * kDirectionVariance;
  covariance(1, 1) += across_v * across_v * kDirectionVariance;
  return covariance;
}

}  // namespace dense_stereo
