// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "camera/lens.hpp"
#include "camera/sky.hpp"
#include "ray_tracing/tracer.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim::bench {

/// A pinhole that no robot carries, for pictures that people look at.
struct FreeCamera {
  Eigen::Vector3d from, to;  ///< m, in `world`: where it is, and what is in the middle of its picture
  double field = 1.0;        ///< rad from the left edge to the right one
  int width = 1600, height = 1000;

  urban_nav_core::Pose place() const;  ///< T_world_camera, level
  /// With so many pixels in place of one, along each side.
  Lens lens(int finer = 1) const;
};

/// 8 bit, BGR: nine rays a pixel, exposed for the lower two thirds, bright parts pressed together instead of cut off.
cv::Mat photograph(const Tracer& tracer, const Sky& sky, const FreeCamera& camera, double t = 0.0);

}  // namespace urban_nav_sim::bench
