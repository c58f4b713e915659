// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "camera/ray_table.hpp"
#include "camera/render.hpp"
#include "motion/motion.hpp"

namespace urban_nav_sim {

/// Motion of a camera in its axes.
struct CameraMotion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();      ///< rad/s
};
CameraMotion computeCameraMotion(const MotionState& motion_state, const urban_nav_core::Pose& T_base_camera);

/// Returns the optical flow of a pixel, px/s. `depth`: m, may be infinite.
Eigen::Vector2f flowAt(const RayTable& rays, int u, int v, float depth, const CameraMotion& motion);

/// Blurs the radiance of a picture by an exposure of `seconds` centred at its time: each pixel along its flow, without
/// disocclusion. The result does not depend on the number of threads.
void blurByMotion(const Picture& picture, const RayTable& rays, const CameraMotion& motion, double seconds,
                  std::vector<float>& radiance);

}  // namespace urban_nav_sim
