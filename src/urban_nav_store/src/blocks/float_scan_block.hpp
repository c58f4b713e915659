// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav_store {

/// Reads the content of a block of scans of schema 11 and older, whose numbers are floats; empty for other bytes.
/// Numbers may be not finite.
std::optional<std::vector<urban_nav_core::Scan>> takeFloatScans(std::string_view bytes);

}  // namespace urban_nav_store
