// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/console.hpp"
#include "base/page.hpp"
#include "loop_metric/parameters.hpp"
#include "map/session_odometry.hpp"
#include "topics/loops/stored_sessions.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Transforms of closure candidates.
struct LoopsRun {
  std::vector<urban_nav_core::MetricClosure> closures;
  std::vector<PagePicture> pictures;  ///< of a few of them: two keyframes with their matches, or two clouds
  std::size_t candidates = 0, accepted_stereo = 0, accepted_icp = 0, rejected = 0;
  double ms_median = 0.0, ms_p99 = 0.0;  ///< per candidate
  double ms = 0.0;                       ///< of all candidates
  std::vector<std::string> warnings;
};

/// Measures the transforms of candidates from the keyframes and scans that `store` holds, which must be committed. Uses
/// the two times and the probability of each candidate alone. Runs on several threads; the result does not depend on
/// their number. `camera`: that of the last session.
LoopsRun runLoops(const loop_metric::Parameters& parameters, const urban_nav_core::StereoCamera& camera,
                  const urban_nav_core::Pose& T_base_camera, const std::vector<CandidateSession>& sessions,
                  urban_nav_store::Store& store, const std::vector<urban_nav_core::MetricClosure>& candidates,
                  Console& console);

}  // namespace urban_nav
