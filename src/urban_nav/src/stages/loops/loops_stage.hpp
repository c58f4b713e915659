// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/console.hpp"
#include "loop_metric/parameters.hpp"
#include "report/page.hpp"
#include "stage/closures_file.hpp"
#include "stage/stored_sessions.hpp"
#include "stages/vo/vo_stage.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// What the stage loops made of its candidates.
struct LoopsRun {
  std::vector<ClosureRow> closures;   ///< each with what was measured
  std::vector<PagePicture> pictures;  ///< of a few of them: two views with their matches
  std::size_t candidates = 0, accepted_stereo = 0, accepted_icp = 0, rejected = 0;
  double ms_median = 0.0, ms_p99 = 0.0;  ///< of a candidate
  double ms = 0.0;                       ///< of all of them
  std::vector<std::string> warnings;
};

/// Finds the transform of each row (a moment pair; what else stands in it is replaced) from the keyframes and scans that `store` holds, which must be
/// committed; on several threads, with results that do not depend on their number. `camera` is that of the last session.
LoopsRun runLoops(const loop_metric::Parameters& parameters, const urban_nav_core::StereoCamera& camera,
                  const urban_nav_core::Pose& T_base_camera, const std::vector<LoopsSession>& sessions,
                  urban_nav_store::Store& store, std::vector<ClosureRow> rows, Console& console);

}  // namespace urban_nav
