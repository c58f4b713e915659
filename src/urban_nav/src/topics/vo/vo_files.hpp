// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "topics/vo/vo_run.hpp"

namespace urban_nav {

/// Returns stats.csv: one row per frame of all sessions. `chosen`: the odometry of each session; the source of a frame
/// is that of the step to it, and of the first frame that of the step from it.
std::string statsCsv(const std::vector<const VoRun*>& runs, const std::vector<const SessionOdometry*>& chosen);
/// Returns landmarks.ply in binary: float x y z (m, `odom`), float sigma (m, along the line of sight), uchar red green
/// blue. Landmarks that were observed in fewer than three frames are left out.
std::string landmarksPly(const VoRun& run);

}  // namespace urban_nav
