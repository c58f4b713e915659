// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "camera/ray_table.hpp"
#include "camera/render.hpp"
#include "motion/motion.hpp"

namespace urban_nav_sim {

/// How a camera moves, in its own axes.
struct CameraMotion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();      ///< rad/s
};
CameraMotion computeCameraMotion(const MotionState& motion_state, const urban_nav_core::Pose& T_base_camera);

/// How fast what a pixel sees goes over the image, px/s. `depth`: m, may be infinite.
Eigen::Vector2f flowAt(const RayTable& rays, int u, int v, float depth, const CameraMotion& motion);

/// The radiance of a picture, smeared as by an exposure of `seconds` whose middle is the time of the picture: each
/// pixel along its own flow, so what is hidden at the middle never shows. Same bytes whatever the number of threads.
void blurByMotion(const Picture& picture, const RayTable& rays, const CameraMotion& motion, double seconds,
                  std::vector<float>& radiance);

}  // namespace urban_nav_sim
