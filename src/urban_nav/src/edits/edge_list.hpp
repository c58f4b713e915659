// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/json.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// The closures of a store and its journal of edits, for `urban_nav edge STORE list`.
std::string listEdges(urban_nav_store::Store& store);
Json edgesAsJson(urban_nav_store::Store& store);

}  // namespace urban_nav
