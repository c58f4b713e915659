// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "camera/lens.hpp"
#include "camera/sky.hpp"
#include "ray_tracing/tracer.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_sim::bench {

/// A free pinhole camera, for pictures of documents.
struct FreeCamera {
  Eigen::Vector3d from, to;  ///< m, in `world`: position, and point in the centre of the image
  double field = 1.0;        ///< rad from the left edge to the right one
  int width = 1600, height = 1000;

  urban_nav_core::Pose place() const;  ///< T_world_camera, level
  /// Returns the lens with `finer` times the resolution.
  Lens lens(int finer = 1) const;
};

/// Renders 8 bit BGR with nine rays per pixel, exposed for the lower two thirds, with compressed highlights.
cv::Mat photograph(const Tracer& tracer, const Sky& sky, const FreeCamera& camera, double t = 0.0);

}  // namespace urban_nav_sim::bench
