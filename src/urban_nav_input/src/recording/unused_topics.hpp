// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

/// Returns a sentence on the topics of a recording that are not in `used`, with type and number of messages, in the
/// order of their names; empty if there are none. Ignores topics of ROS (/rosout, /clock, /diagnostics, /tf).
std::string describeUnusedTopics(Recording& recording, const std::set<std::string>& used);

}  // namespace urban_nav_input
