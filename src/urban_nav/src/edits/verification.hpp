// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// A difference between a store and the same map made again.
struct Difference {
  std::string stage;        ///< that has made it
  std::string session;      ///< name
  std::int64_t minute = 0;  ///< within the session, from 0
  std::string text;
};

/// Relaxes the measurements and edits of `measured`, and returns the differences of poses and verdicts to what `store`
/// holds, with the edits of `store`. Both may be one store.
std::vector<Difference> compareRelaxation(urban_nav_store::Store& store, urban_nav_store::Store& measured);

/// Returns what stages have measured differently in two stores of the same recordings: odometry, keyframes, places,
/// planes of the ground, scans, closures, and, if the store has never been edited, the rendered map.
std::vector<Difference> compareMeasurements(urban_nav_store::Store& store, urban_nav_store::Store& again);

}  // namespace urban_nav
