// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map/context.hpp"
#include "urban_nav_trust/test_results.hpp"

namespace urban_nav {

/// Tests the path of a session in the map against its stored GPS fixes, if they took no part in it. `session`: number
/// over all sessions.
void compareFixes(const MapContext& context, std::size_t session, urban_nav_trust::TestResults& results);

}  // namespace urban_nav
