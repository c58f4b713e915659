// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/session_odometry.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Sessions of earlier runs in a store, with the data that later stages need.
struct PreviousSessions {
  std::vector<urban_nav_store::SessionId> ids;
  std::vector<std::string> names;  ///< as closures.csv names them
  /// Bit-exact odometry chains and covariances, rows of dropped frames, specific forces and extrinsics of the camera;
  /// other members are empty.
  std::vector<SessionOdometry> runs;
  std::int64_t revision = 0;  ///< highest revision of their anchors
};

/// Returns all sessions except those in `without`, in the order of their start. Throws the errors of urban_nav_store.
PreviousSessions readPreviousSessions(urban_nav_store::Store& store,
                                      const std::vector<urban_nav_store::SessionId>& without);

/// Returns whether the store holds a closure of any kind. Its sessions can then be relaxed.
bool holdsClosures(urban_nav_store::Store& store);

}  // namespace urban_nav
