// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/image/patch.hpp"

namespace urban_nav_core {

/// Tangent plane of the surface at a point, in the left optical frame: plane . X = 1 (1/m). Zero is the plane at
/// infinity.

/// Returns the plane through a stereo pixel with the given gradient of disparity (px per px of u and v).
Eigen::Vector3d surfaceThrough(const StereoCamera& camera, const StereoCamera::Pixel& pixel,
                               const Eigen::Vector2d& slopes);

/// Returns the plane through the point at `inverse_depth` (1/z) on `ray` (z = 1). `slant`, 1/m, is (plane.x, plane.y fx
/// / fy).
Eigen::Vector3d leaning(const StereoCamera& camera, const Eigen::Vector3d& ray, double inverse_depth,
                        const Eigen::Vector2d& slant);

/// Returns the plane scaled to another inverse depth of its point on the ray. Where the inverse depth grows fourfold or
/// more, or the ray does not intersect the plane, returns the fronto-parallel plane at that inverse depth.
Eigen::Vector3d surfaceAt(const Eigen::Vector3d& plane, const Eigen::Vector3d& ray, double inverse_depth);

/// Returns the warp of the pixels around the pixel of `ray` into the view of a camera at T_to_from, by the homography
/// of the plane (px of level 0). Empty if the point would lie behind that camera.
std::optional<PatchWarp> warpOfSurface(const StereoCamera& camera, const Eigen::Vector3d& plane,
                                       const Eigen::Vector3d& ray, const Pose& T_to_from);

}  // namespace urban_nav_core
