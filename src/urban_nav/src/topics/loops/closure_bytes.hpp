// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/closure.hpp"

namespace urban_nav {

/// Serialises closures bit-exactly, including evidence.
std::string packClosures(const std::vector<urban_nav_core::MetricClosure>& closures);
/// Inverse of packClosures(); nullopt for other bytes.
std::optional<std::vector<urban_nav_core::MetricClosure>> unpackClosures(std::string_view bytes);

}  // namespace urban_nav
