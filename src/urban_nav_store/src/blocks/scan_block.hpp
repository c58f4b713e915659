// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav_store {

/// Scans as compressed bytes, column by column, so that the directions, which repeat from scan to scan, cost nothing.
std::string packScans(const std::vector<urban_nav_core::Scan>& scans);
/// Empty where the bytes are no such thing, or hold a number that is not finite.
std::optional<std::vector<urban_nav_core::Scan>> unpackScans(std::string_view bytes);

}  // namespace urban_nav_store
