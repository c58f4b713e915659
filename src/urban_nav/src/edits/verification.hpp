// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// A difference between a store and its recomputed map.
struct Difference {
  std::string stage;        ///< that computed the differing result
  std::string session;      ///< name
  std::int64_t minute = 0;  ///< within the session, from 0
  std::string text;
};

/// Relaxes the measurements of `measured` with the edits of `store`, and returns the differences of poses and verdicts
/// to `store`. Both may be the same store.
std::vector<Difference> compareRelaxation(urban_nav_store::Store& store, urban_nav_store::Store& measured);

/// Returns the differences between measurements of two stores of the same recordings: odometry, keyframes, places,
/// ground planes, scans, closures, and the rendered map if the store has never been edited.
std::vector<Difference> compareMeasurements(urban_nav_store::Store& store, urban_nav_store::Store& again);

}  // namespace urban_nav
