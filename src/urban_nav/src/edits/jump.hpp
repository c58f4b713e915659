// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "edits/edited_map.hpp"

namespace urban_nav {

/// The closures that hold a pose where it is in its map.
struct JumpExplanation {
  /// An accepted closure, or all constraints from planes together.
  struct Cause {
    std::int64_t id = 0;    ///< closure; 0: the planes
    std::string text;       ///< for a person
    double distance = 0.0;  ///< m: how far away the pose lies without it
    double angle = 0.0;     ///< rad
    bool joins = false;     ///< without it the pose lies in another map than its origin
  };
  std::string moment;                  ///< the pose, for a person
  double distance = 0.0, angle = 0.0;  ///< m, rad: from where odometry alone has it, seen from the map's first pose
  bool in_own_map = true;              ///< odometry leads from the map's first pose to it
  std::vector<Cause> causes;           ///< the largest first
  std::size_t left_out = 0;            ///< closures that were not tried, whose residuals are the smallest
};

/// Relaxes the map of a store without each of its accepted closures in turn, with the verdicts of the others as they
/// are.
JumpExplanation explainJump(urban_nav_store::Store& store, const std::string& moment);

std::string explain(const JumpExplanation& jump);
Page explainOnPage(const JumpExplanation& jump, const std::string& store);
Json explainAsJson(const JumpExplanation& jump);

}  // namespace urban_nav
