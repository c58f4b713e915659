// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_store/input_order.hpp"

namespace urban_nav_store {

/// Encodes input events as compressed bytes.
std::string packEvents(const std::vector<InputEvent>& events);
/// Inverse of packEvents(); empty for other bytes.
std::optional<std::vector<InputEvent>> unpackEvents(std::string_view bytes);

}  // namespace urban_nav_store
