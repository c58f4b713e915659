// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Stored covariances of the poses of a session, in the convention of PoseWithCovariance.
struct StoredCovariances {
  /// One per pose, relative to the first pose of its map. Empty for stores written live or by an earlier version.
  std::vector<urban_nav_core::Matrix6d> poses;
  std::vector<urban_nav_core::Matrix6d> steps;  ///< T_from_to, one per pose but the first
};

/// Returns the covariances of a session: from the pose graph for relaxed poses, else from odometry.
StoredCovariances readStoredCovariances(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// Returns all closures of a store as closures.csv, in the order and with the session names of `map`.
std::string readStoredClosures(urban_nav_store::Store& store);
/// Returns the candidates from which `map` made the closures between some sessions of a store, in the same order:
/// measured ones without their result, those of a file unchanged, none that were added by edits.
std::string readStoredCandidates(urban_nav_store::Store& store,
                                 const std::vector<urban_nav_store::SessionId>& sessions);

}  // namespace urban_nav
