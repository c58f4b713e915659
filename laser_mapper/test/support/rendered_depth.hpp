// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <random>

#include "support/scanned_room.hpp"
#include "urban_nav_store/tables/depth_view.hpp"

namespace laser_mapper::testing_room {

/// Returns the range to the first intersection of a ray, m. Direction: unit vector.
using Scene = std::function<double(const Vector3d& origin, const Vector3d& direction)>;

/// A camera along the x axis of the robot, 1.2 m up.
inline Pose roomCamera() {
  Eigen::Matrix3d R;
  R.col(0) = -Vector3d::UnitY();
  R.col(1) = -Vector3d::UnitZ();
  R.col(2) = Vector3d::UnitX();
  return Pose(R, Vector3d(0.2, 0.0, 1.2));
}

/// Renders the disparities of a camera of 320x240 px and 0.25 m of baseline, with noise of `sigma` px and without
/// session.
inline urban_nav_store::DepthView depthOfScene(const Scene& scene, const Pose& T_map_base, StampNs stamp, float sigma,
                                               unsigned seed) {
  urban_nav_store::DepthView view;
  view.stamp = stamp;
  view.step = 2;
  view.fx = view.fy = 260.0;
  view.cx = 159.5;
  view.cy = 119.5;
  view.baseline = 0.25;
  view.T_base_camera = roomCamera();
  urban_nav_store::DepthView::Samples samples;
  samples.width = 160;
  samples.height = 120;
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.0F, sigma);
  const Pose T_map_camera = T_map_base * view.T_base_camera;
  for (int v = 0; v < samples.height; ++v)
    for (int u = 0; u < samples.width; ++u) {
      const Vector3d ray((2.0 * u - view.cx) / view.fx, (2.0 * v - view.cy) / view.fy, 1.0);
      const double depth = scene(T_map_camera.t(), T_map_camera.q() * ray.normalized()) / ray.norm();
      samples.disparity.push_back(static_cast<float>(view.fx * view.baseline / depth) + noise(random));
      samples.sigma.push_back(sigma);
      samples.grey.push_back(120);
    }
  view.packed = urban_nav_store::DepthView::pack(samples);
  return view;
}

}  // namespace laser_mapper::testing_room
