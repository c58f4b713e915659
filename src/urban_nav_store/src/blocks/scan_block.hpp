// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"

namespace urban_nav_store {

/// Encodes scans as compressed bytes, by column, so that directions repeated in all scans take hardly any space.
std::string packScans(const std::vector<urban_nav_core::Scan>& scans);
/// Inverse of packScans(); empty for other bytes or numbers that are not finite.
std::optional<std::vector<urban_nav_core::Scan>> unpackScans(std::string_view bytes);

}  // namespace urban_nav_store
