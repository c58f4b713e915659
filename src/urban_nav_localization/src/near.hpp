// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_localization/localiser.hpp"

namespace urban_nav_localization {

/// Returns whether an estimate is accurate enough to select nearby places of the map: if Localized, or if an initial
/// pose is accurate enough. A single match is not sufficient, since it may be false.
inline bool isNearKnownPlace(const LocalizationEstimate& estimate) {
  constexpr double kMaxInitialSigma = 2.0;  // m
  if (!estimate.T_map_base) return false;
  if (estimate.state == LocalizationState::Localized) return true;
  return estimate.supporting_matches == 0 &&
         estimate.T_map_base->covariance.topLeftCorner<3, 3>().trace() <= kMaxInitialSigma * kMaxInitialSigma;
}

}  // namespace urban_nav_localization
