// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "map/context.hpp"

namespace urban_nav {

/// Stores the GPS fixes of a session; a second call changes nothing. Bags without any, and folders, are fine.
void storeFixes(MapContext& context, std::size_t session);

}  // namespace urban_nav
