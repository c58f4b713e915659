// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/session_odometry.hpp"

namespace urban_nav {

/// Fuses stereo and laser odometry of a session. Returns the frames of `stereo` with fused poses and covariances; the
/// first pose is that of `stereo`.
SessionOdometry fuseSession(const SessionOdometry& stereo, const SessionOdometry& laser);

/// Returns the conflicts of a fused session as sentences for the user, the largest one with its time; empty if none.
std::vector<std::string> conflictSentences(const SessionOdometry& fused);
/// Returns a note on constants whose prior the comparison contradicts, such as a wrong baseline; empty if none.
std::vector<std::string> constantSentences(const SessionOdometry& fused);

}  // namespace urban_nav
