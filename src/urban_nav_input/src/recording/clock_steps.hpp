// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

/// Time in a recording at which a clock was set back.
struct ClockStep {
  urban_nav_core::StampNs receipt = 0;  ///< of the first message stamped by the new time
  urban_nav_core::StampNs back = 0;     ///< ns by which its stamp precedes that of the previous message; positive
};

/// Returns the times at which the stamps of a topic step back by more than a second while times of receipt ascend, in
/// the order of receipt. Steps of several topics less than a second apart are one. Reads the headers of a few hundred
/// messages per topic, evenly distributed: of several steps between two of them at most one is found.
std::vector<ClockStep> findClockSteps(Recording& recording, const std::vector<std::string>& topics);

}  // namespace urban_nav_input
