// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// The map of a store before its first edit, for stores whose map is not the one that this program makes of their
/// measurements: of a robot that relaxed as it drove, of another version, or merged from maps that were made apart.

/// Keeps the poses, verdicts and graph.g2o of all sessions. Does not commit.
void keepBase(urban_nav_store::Store& store);
/// Returns whether a map is kept.
bool holdsBase(urban_nav_store::Store& store);
/// Brings the kept map back. Requires holdsBase(). Does not commit. Throws DataError if it is damaged.
void restoreBase(urban_nav_store::Store& store);
/// Forgets it: another relaxation has taken its place.
void forgetBase(urban_nav_store::Store& store);

}  // namespace urban_nav
