// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Covariances of a session's poses as a store holds them, in the convention of PoseWithCovariance.
struct StoredCovariances {
  /// One per pose, which is relative to the first pose of its map; empty: the store was written live, or by an earlier
  /// version, and holds none.
  std::vector<urban_nav_core::Matrix6d> poses;
  std::vector<urban_nav_core::Matrix6d> steps;  ///< T_from_to, one per pose but the first
};

/// Returns the covariances of a session: those of the pose graph where it has relaxed a pose, else those of odometry.
StoredCovariances readStoredCovariances(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

/// Returns all closures of a store as closures.csv, in the order and with the session names of `map`.
std::string readStoredClosures(urban_nav_store::Store& store);
/// Returns the candidates of which `map` made the closures between some sessions of a store, in the same order: those
/// that a stage has measured without what it found, those of a file as they were there, and none that edits have added.
std::string readStoredCandidates(urban_nav_store::Store& store,
                                 const std::vector<urban_nav_store::SessionId>& sessions);

}  // namespace urban_nav
