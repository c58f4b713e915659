// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/session_odometry.hpp"

namespace urban_nav {

/// Returns the odometry of a session from those by stereo and by laser: the frames of `stereo` with fused poses and
/// covariances. The first pose is that by stereo.
SessionOdometry fuseSession(const SessionOdometry& stereo, const SessionOdometry& laser);

/// Returns the conflicts of a fused session as sentences for the user, the largest one with its place; empty if none.
std::vector<std::string> conflictSentences(const SessionOdometry& fused);
/// Returns a note on constants whose prior the comparison contradicts, such as a wrong baseline; empty if none.
std::vector<std::string> constantSentences(const SessionOdometry& fused);

}  // namespace urban_nav
