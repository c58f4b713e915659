// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "map/context.hpp"

namespace urban_nav {

/// Stores the GPS fixes of a session, once. No effect for bags without fixes and for folders.
void storeFixes(MapContext& context, std::size_t session);

}  // namespace urban_nav
