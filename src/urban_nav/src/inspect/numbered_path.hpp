// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace urban_nav {

/// Returns the path of a map's file: "out.tum" for map 0, "out_2.tum" for map 1, and so on.
std::string numberedPath(const std::string& path, std::size_t map);

}  // namespace urban_nav
