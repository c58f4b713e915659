// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <utility>

#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// The two poses of each of some closures, whichever of them is named first; sessions by their ids.
using ClosurePoses = std::set<std::pair<urban_nav_core::PoseRef, urban_nav_core::PoseRef>>;

/// Adds the closures of a store that were measured and accepted.
void addAcceptedClosures(urban_nav_store::Store& store, ClosurePoses& closures);

/// Returns a warning about closures of `before` between poses of which the relaxed graph of a store has no edge; empty
/// if all have one.
std::string lostClosuresWarning(urban_nav_store::Store& store, const ClosurePoses& before);

}  // namespace urban_nav
