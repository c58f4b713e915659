// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "edits/edited_map.hpp"

namespace urban_nav {

/// The closures that determine a pose in its map.
struct JumpExplanation {
  /// An accepted closure, or all constraints from planes together.
  struct Cause {
    std::int64_t id = 0;    ///< closure; 0: the planes
    std::string text;       ///< description for the user
    double distance = 0.0;  ///< m, displacement of the pose without it
    double angle = 0.0;     ///< rad
    bool joins = false;     ///< without it the pose is disconnected from the origin of its map
  };
  std::string moment;                  ///< session and time of the pose, for the user
  double distance = 0.0, angle = 0.0;  ///< m, rad: from its pose by odometry, relative to the first pose of the map
  bool in_own_map = true;              ///< the first pose of the map is in the same session
  std::vector<Cause> causes;           ///< in descending order of their effect
  std::size_t left_out = 0;            ///< number of closures not tried: those with the smallest residuals
};

/// Relaxes the map of a store without each of its accepted closures in turn, keeping the verdicts of the others.
JumpExplanation explainJump(urban_nav_store::Store& store, const std::string& moment);

std::string explain(const JumpExplanation& jump);
Page explainOnPage(const JumpExplanation& jump, const std::string& store);
Json explainAsJson(const JumpExplanation& jump);

}  // namespace urban_nav
