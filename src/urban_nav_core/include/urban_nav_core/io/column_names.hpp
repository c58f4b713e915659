// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_core {

/// Quantities of table columns.
enum class Quantity { Stamp, X, Y, Z, Qx, Qy, Qz, Qw };

/// Returns the quantity named by a column header, in the spellings of common programs: `x`, `//X`, `Points:0`,
/// `pose.position.x`, `p_RS_R_x [m]`, `q_RS_w []`, `field.header.stamp`, `%time`, `#timestamp [ns]`. nullopt for names
/// of velocities, normals, covariances and colours.
std::optional<Quantity> readQuantity(std::string_view name);

/// Returns the index of the column that holds a quantity, preferring the simplest name; nullopt if there is none.
std::optional<std::size_t> findColumn(const std::vector<std::string>& header, Quantity quantity);

/// Returns a name for comparisons: in lower case, without quotes, comment marks, surrounding blanks and the unit in
/// brackets.
std::string plainName(std::string_view name);

/// Returns the size in m or s of the unit in a name's brackets ("x [mm]": 0.001); nullopt without a known unit.
std::optional<double> readUnit(std::string_view name);

}  // namespace urban_nav_core
