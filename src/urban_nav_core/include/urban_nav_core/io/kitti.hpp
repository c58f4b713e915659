// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_core {

/// KITTI's pose files: a line per frame, the 3x4 matrix [R t] row by row, without stamps. Matrices are read back
/// bit-exactly; poses, whose rotation is a quaternion, to 1e-15.
using KittiMatrix = Eigen::Matrix<double, 3, 4>;
std::string printKitti(const std::vector<KittiMatrix>& matrices);
std::string printKitti(const std::vector<Pose>& poses);
void writeKitti(const std::string& path, const std::vector<Pose>& poses);

/// Parse matrices. Throw UserError with file and line for lines that do not hold twelve finite numbers, and if R is not
/// a rotation to 1e-3.
std::vector<KittiMatrix> parseKittiMatrices(std::string_view text, const std::string& name);
std::vector<Pose> readKitti(const std::string& path);
std::vector<Pose> parseKitti(std::string_view text, const std::string& name);

/// Reads times.txt: seconds, one a line, strictly increasing. Throws UserError with file and line.
std::vector<StampNs> readTimes(const std::string& path);
std::vector<StampNs> parseTimes(std::string_view text, const std::string& name);
/// Calls `time(word, stamp, where)` for each row of such a file, a TextTable of one column, in file order; stamps may
/// be in any order. Times since 1970 may be in ms, us or ns, by their magnitude, others in us or ns by their intervals.
/// Throws UserError with file and line for non-numeric words.
void forEachTime(std::string_view text, const std::string& name,
                 const std::function<void(std::string_view word, StampNs stamp, const std::string& where)>& time);
/// Returns the stamp of a time in seconds, in decimal or exponential notation (1.038170e-01); nullopt if not a number.
std::optional<StampNs> parseTime(std::string_view word);

}  // namespace urban_nav_core
