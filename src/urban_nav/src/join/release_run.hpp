// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/parameter_set.hpp"
#include "join/release_selection.hpp"
#include "urban_nav_store/release.hpp"

namespace urban_nav {

/// Contents of a written release.
struct ReleaseRun {
  urban_nav_store::ReleaseHead head;
  std::size_t sessions = 0, places = 0, keyframes = 0;
  std::int64_t bytes = 0;
  std::vector<std::string> warnings;
};

/// Writes the first map of a store as a release. Throws DataError for a damaged or unfinished store and one without a
/// map, UserError for a file that is not a store.
ReleaseRun makeRelease(const std::string& store, const std::string& out, const ParameterSet& parameters);

/// Writes rows of a store, which may be a release, as a release at `out`. `first`: the session whose first pose is the
/// origin of the map. Fills all but the warnings of the result.
ReleaseRun writeRelease(const std::string& source, const std::vector<KeptSession>& kept,
                        const urban_nav_store::SessionId& first, urban_nav_store::ReleaseHead head,
                        const std::string& out);

/// Differences between two releases.
struct ReleaseDifference {
  std::size_t places_lost = 0, places_new = 0;  ///< by where they are
  std::size_t places_moved = 0;                 ///< in both releases, at different poses
  double surfaces_gone_m2 = 0.0, surfaces_new_m2 = 0.0;
  std::vector<std::string> warnings;
};

/// Returns the changes from release `a` to release `b`. Throws DataError if their maps have no common frame: neither is
/// the parent of the other, and they have no common parent. `memory_mb`: limit for the point maps.
ReleaseDifference compareReleases(const std::string& a, const std::string& b, double memory_mb);

}  // namespace urban_nav
