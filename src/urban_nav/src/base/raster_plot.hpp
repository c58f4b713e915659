// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/plot.hpp"

namespace urban_nav {

/// Lines and dots of plots with their titles, one below the other, as a PNG for light paper. Bands, bars and spans are
/// left out.
std::vector<unsigned char> rasterPng(const std::vector<std::pair<std::string, Plot>>& plots);

}  // namespace urban_nav
