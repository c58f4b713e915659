// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// The map of a store before its first edit, for stores whose map this program would not reproduce from their
/// measurements: relaxed live on a robot, written by another version, or merged from separate maps.

/// Keeps the poses, verdicts and graph.g2o of all sessions. Does not commit.
void keepBase(urban_nav_store::Store& store);
/// Returns whether a map is kept.
bool holdsBase(urban_nav_store::Store& store);
/// Restores the kept map. Requires holdsBase(). Does not commit. Throws DataError if it is damaged.
void restoreBase(urban_nav_store::Store& store);
/// Removes the kept map, after another relaxation.
void forgetBase(urban_nav_store::Store& store);

}  // namespace urban_nav
