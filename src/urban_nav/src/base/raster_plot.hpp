// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/plot.hpp"

namespace urban_nav {

/// Returns plots with their titles, one below the other, as a PNG on white. Draws only lines and dots; bands, bars and
/// spans are omitted.
std::vector<unsigned char> rasterPng(const std::vector<std::pair<std::string, Plot>>& plots);

}  // namespace urban_nav
