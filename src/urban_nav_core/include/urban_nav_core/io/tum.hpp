// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_core {

/// TUM's format: a line per pose, `stamp x y z qx qy qz qw`, stamp in s with nine decimals, m; `#` begins a comment.
/// Poses are read back bit-exactly.
std::string printTum(const Trajectory& trajectory);
void writeTum(const std::string& path, const Trajectory& trajectory);

/// Repairs that the tolerant reader made.
struct TumRepairs {
  std::size_t repeated = 0;      ///< lines dropped as duplicates of an earlier stamp
  std::size_t out_of_order = 0;  ///< lines that were sorted
  std::size_t not_finite = 0;    ///< lines dropped: a number is missing or not finite, or the quaternion is zero
  double unit = 1.0;             ///< s: of the stamps; 1e-9 where they are in nanoseconds
};

/// Order of columns in a file whose header does not name them.
enum class PoseOrder {
  Tum,   ///< stamp x y z qx qy qz qw
  Euroc  ///< stamp in ns, x y z, qw qx qy qz, others
};

/// Reads the format, and pose tables in any form of TextTable, whose columns are found by their names (readQuantity())
/// or else are in `order`. Throws UserError with file and line for lines without eight finite numbers, quaternions that
/// are not of unit length to 1 %, and stamps that do not increase. With `repairs`, repeated stamps, lines out of order
/// or not finite and stamps in ms, us or ns (from 1971 on, or as stated by the header) are not errors but counted
/// there.
Trajectory readTum(const std::string& path, TumRepairs* repairs = nullptr, PoseOrder order = PoseOrder::Tum);
/// Parses the content of such a file; `name` replaces the path in errors.
Trajectory parseTum(std::string_view text, const std::string& name, TumRepairs* repairs = nullptr,
                    PoseOrder order = PoseOrder::Tum);

/// Returns "t_x t_y t_z q_x q_y q_z q_w", as in a line of the format.
std::string printTumPose(const Pose& pose);

}  // namespace urban_nav_core
