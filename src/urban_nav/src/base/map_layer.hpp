// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace urban_nav {

/// Maximum number of points in the 3D view of the report.
constexpr std::size_t kMostShownPoints = 500'000;

/// Returns markup that adds a colouring to the map view that precedes it on the page. `number`: index of the view.
/// `kinds`: index in `colours` (red, green, blue) for each point of the view, in its order.
std::string renderMapLayer(std::size_t number, const std::string& name, const std::vector<unsigned char>& kinds,
                           const std::vector<std::array<int, 3>>& colours);

}  // namespace urban_nav
