// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/image/patch.hpp"

namespace urban_nav_core {

/// The piece of surface about a point that a left camera sees, as a plane in its optical frame: plane . X = 1 (1/m);
/// zero: at infinity.

/// Through a point with slopes of disparity (d per px of u and v).
Eigen::Vector3d surfaceThrough(const StereoCamera& camera, const StereoCamera::Pixel& pixel,
                               const Eigen::Vector2d& slopes);

/// Through the point at `inverse_depth` (1/z) on `ray` (z = 1) with the slant (1/m) that plane.x and plane.y fx / fy
/// are.
Eigen::Vector3d leaning(const StereoCamera& camera, const Eigen::Vector3d& ray, double inverse_depth,
                        const Eigen::Vector2d& slant);

/// The plane moved along the ray to another inverse depth of its point; facing the camera where that is no mere
/// correction.
Eigen::Vector3d surfaceAt(const Eigen::Vector3d& plane, const Eigen::Vector3d& ray, double inverse_depth);

/// How pixels about the ray's pixel move into the view of a camera at T_to_from, by the homography of the plane (px of
/// level 0). Empty if the point would lie behind that camera.
std::optional<PatchWarp> warpOfSurface(const StereoCamera& camera, const Eigen::Vector3d& plane,
                                       const Eigen::Vector3d& ray, const Pose& T_to_from);

}  // namespace urban_nav_core
