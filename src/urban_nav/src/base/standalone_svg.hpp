// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/plot.hpp"

namespace urban_nav {

/// Plots with their titles, one below the other, as an SVG file of its own with colours for light paper.
std::string standaloneSvg(const std::vector<std::pair<std::string, Plot>>& plots);

}  // namespace urban_nav
