// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

/// Mounting of the LiDAR in KITTI's files. All functions throw UserError with file and line for rows with too few or
/// too many numbers, numbers that are not finite, and matrices that are not rotations to 1e-3.

/// Returns T_camera_lidar of calib.txt, of the rectified left camera: the row `Tr: ` (`Tr_velo_to_cam: `,
/// `Tr_velo_cam: `) with a 3x4 matrix, row by row; nullopt without such a row.
std::optional<Pose> parseKittiTr(std::string_view text, const std::string& name);
/// Returns T_camera_lidar of calib_velo_to_cam.txt, of the left camera before rectification: rows `R: ` with nine and
/// `T: ` with three numbers (m). Throws UserError without them.
Pose parseKittiVeloToCam(std::string_view text, const std::string& name);
/// Returns the rotation from the left camera before rectification to the rectified one: the row `R_rect_00: ` of
/// calib_cam_to_cam.txt; nullopt without it.
std::optional<Matrix3d> parseKittiRectification(std::string_view text, const std::string& name);

}  // namespace urban_nav_core
