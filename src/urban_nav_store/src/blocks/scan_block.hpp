// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav_store {

/// Encodes scans as compressed bytes, by column: stamps as differences, each direction once, ranges of whole
/// millimetres and whole intensities as integers minus those of the last beam in the same direction. Bit-exact: if one
/// range of the block is not a whole number of millimetres, all are floats; the same holds for intensities.
std::string packScans(const std::vector<urban_nav_core::Scan>& scans);
/// Inverse of packScans(), also of that of schema 11 and older; empty for other bytes or numbers that are not finite.
std::optional<std::vector<urban_nav_core::Scan>> unpackScans(std::string_view bytes);

}  // namespace urban_nav_store
