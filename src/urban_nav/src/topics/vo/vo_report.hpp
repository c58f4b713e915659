// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/page.hpp"
#include "topics/vo/vo_run.hpp"
#include "topics/vo/vo_summary.hpp"

namespace urban_nav {

/// Returns the sections on visual odometry of a session: path, uncertainty, features, timing, frames with tracks.
/// `with_path`: false if the path is already shown against the truth.
std::vector<Section> voSections(const VoRun& run, bool with_path);

/// Returns the verdicts on visual odometry.
std::vector<Verdict> voVerdicts(const VoSummary& summary);

}  // namespace urban_nav
