// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <utility>

#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Pairs of poses of closures, independent of their order; sessions by their ids.
using ClosurePoses = std::set<std::pair<urban_nav_core::PoseRef, urban_nav_core::PoseRef>>;

/// Adds the closures of a store that were measured and accepted.
void addAcceptedClosures(urban_nav_store::Store& store, ClosurePoses& closures);

/// Returns a warning about closures of `before` that have no edge in the relaxed graph of a store; empty if all have
/// one.
std::string lostClosuresWarning(urban_nav_store::Store& store, const ClosurePoses& before);

}  // namespace urban_nav
