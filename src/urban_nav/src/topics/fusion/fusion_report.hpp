// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/page.hpp"
#include "map/session_odometry.hpp"

namespace urban_nav {

/// Returns one line for the console: steps by source, and the scale of stereo.
std::string fusionSentence(const SessionOdometry& fused);
/// Requires `fused.fusion`.
Section fusionSection(const SessionOdometry& fused);
std::vector<Verdict> fusionVerdicts(const SessionOdometry& fused);
}  // namespace urban_nav
