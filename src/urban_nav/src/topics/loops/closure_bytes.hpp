// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/closure.hpp"

namespace urban_nav {

/// Returns closures as bytes, to the last bit, evidence included.
std::string packClosures(const std::vector<urban_nav_core::MetricClosure>& closures);
/// Returns the closures that packClosures() wrote; nullopt for any other bytes.
std::optional<std::vector<urban_nav_core::MetricClosure>> unpackClosures(std::string_view bytes);

}  // namespace urban_nav
