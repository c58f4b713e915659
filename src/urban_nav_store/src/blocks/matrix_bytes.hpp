// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_store {

/// Returns a matrix as little-endian numbers, row by row: the 21 of the upper triangle if it is exactly symmetric, else
/// 36.
std::string matrixBytes(const urban_nav_core::Matrix6d& matrix);
/// Inverse of matrixBytes(). Returns false for any other number of bytes and for numbers that are not finite.
bool parseMatrix(std::string_view bytes, urban_nav_core::Matrix6d& matrix);

}  // namespace urban_nav_store
