// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_core {

/// TUM's format: a line per pose, `stamp x y z qx qy qz qw`, stamp in s with nine decimals, m; `#` begins a comment.
/// What is written reads back to the last bit.
std::string printTum(const Trajectory& trajectory);
void writeTum(const std::string& path, const Trajectory& trajectory);

/// What a tolerant reader made of a file that breaks the rules.
struct TumRepairs {
  std::size_t repeated = 0;      ///< lines left out, their stamp having come before
  std::size_t out_of_order = 0;  ///< lines that were sorted
  std::size_t not_finite = 0;    ///< lines left out: a number is missing or not finite, or the quaternion is zero
  double unit = 1.0;             ///< s: of the stamps; 1e-9 where they are in nanoseconds
};

/// The order of columns in a file whose header does not name them.
enum class PoseOrder {
  Tum,   ///< stamp x y z qx qy qz qw
  Euroc  ///< stamp in ns, x y z, qw qx qy qz, others
};

/// Reads the format, and tables of poses in every form that TextTable reads, whose columns are found by their names
/// (readQuantity()) or else are in `order`. Throws UserError with file and line for lines that do not hold eight finite
/// numbers, quaternions that are not of length one to 1 %, and stamps that are not later than the one before. With
/// `repairs`, repeated stamps, lines out of order or not finite and stamps in ms, us or ns (from 1971 on, or as the
/// header states) are not errors but counted there.
Trajectory readTum(const std::string& path, TumRepairs* repairs = nullptr, PoseOrder order = PoseOrder::Tum);
/// Parses the content of such a file; `name` replaces the path in errors.
Trajectory parseTum(std::string_view text, const std::string& name, TumRepairs* repairs = nullptr,
                    PoseOrder order = PoseOrder::Tum);

/// "t_x t_y t_z q_x q_y q_z q_w", as in a line of the format.
std::string printTumPose(const Pose& pose);

}  // namespace urban_nav_core
