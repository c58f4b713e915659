// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/parameter_set.hpp"
#include "join/release_selection.hpp"
#include "urban_nav_store/release.hpp"

namespace urban_nav {

/// Contents of a release that was written.
struct ReleaseRun {
  urban_nav_store::ReleaseHead head;
  std::size_t sessions = 0, places = 0, keyframes = 0;
  std::int64_t bytes = 0;
  std::vector<std::string> warnings;
};

/// Freezes the first map of a store into a release. Throws DataError for a damaged or unfinished store and one without
/// a map, UserError for a file that is no store.
ReleaseRun makeRelease(const std::string& store, const std::string& out, const ParameterSet& parameters);

/// Freezes rows of a store, which may be a release, into a release at `out`. `first`: the session at whose first pose
/// the map has its origin. Fills all but the warnings of the result.
ReleaseRun writeRelease(const std::string& source, const std::vector<KeptSession>& kept,
                        const urban_nav_store::SessionId& first, urban_nav_store::ReleaseHead head,
                        const std::string& out);

/// Differences between two releases.
struct ReleaseDifference {
  std::size_t places_lost = 0, places_new = 0;  ///< by where they are
  std::size_t places_moved = 0;                 ///< of both, at another pose
  double surfaces_gone_m2 = 0.0, surfaces_new_m2 = 0.0;
  std::vector<std::string> warnings;
};

/// Returns what changed from release `a` to release `b`. Throws DataError if neither is the other's parent and they
/// share none: their maps have no common frame. `memory_mb`: for the maps of points.
ReleaseDifference compareReleases(const std::string& a, const std::string& b, double memory_mb);

}  // namespace urban_nav
