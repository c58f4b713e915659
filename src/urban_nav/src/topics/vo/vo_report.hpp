// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/page.hpp"
#include "topics/vo/vo_run.hpp"
#include "topics/vo/vo_summary.hpp"

namespace urban_nav {

/// What visual odometry has to show of one session: path, trust, features, timing, frames with tracks. `with_path`:
/// false where the path is shown against the truth already.
std::vector<Section> voSections(const VoRun& run, bool with_path);

/// What it says in plain words.
std::vector<Verdict> voVerdicts(const VoSummary& summary);

}  // namespace urban_nav
