// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/console.hpp"
#include "base/json.hpp"
#include "map/session_odometry.hpp"
#include "urban_nav_localization/localiser.hpp"
#include "urban_nav_localization/parameters.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Localization of a session in a map that is only read.
struct LocalizationRun {
  std::vector<urban_nav_localization::LocalizationEstimate>
      frames;  ///< one per smoothed frame, from observations up to it
  /// All frames, from all observations; empty if the session was never localized.
  urban_nav_core::Trajectory T_map_base;
  std::size_t looks = 0, sightings = 0;              ///< keyframes compared, and transforms found
  std::size_t cloud_looks = 0, cloud_sightings = 0;  ///< local clouds compared, and transforms found
  double first_known_s = -1.0;                       ///< from the first frame to the first known one; negative: never
  double known_share = 0.0;                          ///< of the frames
  double ms_median = 0.0;                            ///< per keyframe
  std::vector<std::string> warnings;
};

/// Registers the keyframes of the run in `own` to those of the map of the first session of `frozen`: near the estimated
/// pose if there is one, else all. After some metres without a match, registers local clouds instead, if both stores
/// have scans or sweeps; without keyframes in both, only these. Throws UserError if the two have nothing in common,
/// DataError if the keyframes of the map are of an unknown camera.
LocalizationRun runLocalization(const urban_nav_localization::Parameters& parameters, urban_nav_store::Store& frozen,
                                urban_nav_store::Store& own, const urban_nav_store::SessionId& id,
                                const SessionOdometry& run, Console& console);

/// Returns localisation.csv, a row per smoothed frame: stamp_ns, knowledge (KNOWN, NEW, UNSURE), witnesses, x...qw of
/// T_map_base and 36 numbers of its covariance (empty if unknown), sentence.
std::string localizationCsv(const LocalizationRun& run);

/// Returns the object "localisation" of summary.json.
Json toJson(const LocalizationRun& run);

}  // namespace urban_nav
