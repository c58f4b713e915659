// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_core {

/// Quantities that columns of tables hold.
enum class Quantity { Stamp, X, Y, Z, Qx, Qy, Qz, Qw };

/// Returns the quantity that a column's name states, in the spellings of common programs: `x`, `//X`, `Points:0`,
/// `pose.position.x`, `p_RS_R_x [m]`, `q_RS_w []`, `field.header.stamp`, `%time`, `#timestamp [ns]`. Names of
/// velocities, normals, covariances and colours state none.
std::optional<Quantity> readQuantity(std::string_view name);

/// Returns the number of the column that holds a quantity, the plainest name first; nullopt where none does.
std::optional<std::size_t> findColumn(const std::vector<std::string>& header, Quantity quantity);

/// Returns a name in lower case without quotes, comment marks, surrounding blanks and its unit in brackets, for
/// comparisons.
std::string plainName(std::string_view name);

/// Returns the size in m or s of the unit in a name's brackets ("x [mm]": 0.001); nullopt where it states none that is
/// known.
std::optional<double> readUnit(std::string_view name);

}  // namespace urban_nav_core
