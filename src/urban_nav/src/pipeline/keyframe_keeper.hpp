// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "loop_metric/keyframe.hpp"
#include "loop_metric/parameters.hpp"
#include "pipeline/vo_stage.hpp"
#include "urban_nav_store/keyframe_store.hpp"

namespace urban_nav {

/// Chooses the views of a session that are kept for the stage loops: the first, and each one behind so much way or so much of a turn, by odometry as
/// it was at the moment. The same run gives the same views, also where it goes on behind a bag.
class KeyframeKeeper {
 public:
  KeyframeKeeper(const loop_metric::Parameters& parameters, const urban_nav_core::StereoCamera& camera);

  /// Goes on behind `run`, of which the views at `kept` (ascending) were kept.
  void goOn(const VoRun& run, const std::vector<urban_nav_core::StampNs>& kept);

  /// To be called for each frame with its row.
  std::optional<urban_nav_store::StoredKeyframe> process(const urban_nav_core::StereoPair& pair, const VoRow& row);

 private:
  const double way_, turn_;
  loop_metric::KeyframeMaker maker_;
  std::optional<urban_nav_core::Pose> last_;  // T_odom_base of the last view that was kept
};

}  // namespace urban_nav
