// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/plot.hpp"

namespace urban_nav {

/// Returns plots with their titles, one below the other, as a standalone SVG file on white.
std::string standaloneSvg(const std::vector<std::pair<std::string, Plot>>& plots);

}  // namespace urban_nav
