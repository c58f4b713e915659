// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_core {

/// TUM's format: a line per pose, `stamp x y z qx qy qz qw`, stamp in s with nine decimals, m; `#` begins a comment.
/// What is written reads back to the last bit.
std::string printTum(const Trajectory& trajectory);
void writeTum(const std::string& path, const Trajectory& trajectory);

/// Throws UserError with file and line for lines that do not hold eight finite numbers, quaternions that are not of
/// length one to 1 %, and stamps that are not later than the one before.
Trajectory readTum(const std::string& path);
/// The same from text; `name` stands for the path in errors.
Trajectory parseTum(std::string_view text, const std::string& name);

/// "t_x t_y t_z q_x q_y q_z q_w", as in a line of the format.
std::string printTumPose(const Pose& pose);

}  // namespace urban_nav_core
