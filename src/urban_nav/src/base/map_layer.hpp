// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace urban_nav {

/// Points of a map that the report shows in three dimensions, at most.
constexpr std::size_t kMostShownPoints = 500'000;

/// Returns markup that adds a way of colouring to the view of a map that stands on the page before it. `number`: of the
/// view. `kinds`: one per point that the view shows, in its order: index in `colours` (red, green, blue).
std::string renderMapLayer(std::size_t number, const std::string& name, const std::vector<unsigned char>& kinds,
                           const std::vector<std::array<int, 3>>& colours);

}  // namespace urban_nav
