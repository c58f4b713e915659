// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "loop_metric/keyframe.hpp"
#include "loop_metric/keyframe_choice.hpp"
#include "loop_metric/parameters.hpp"
#include "pipeline/vo_stage.hpp"
#include "urban_nav_store/keyframe_store.hpp"

namespace urban_nav {

/// The views of a session that are kept for the stage loops, as KeyframeChoice has it. The same run gives the same views, also where it goes on
/// behind a bag.
class KeyframeKeeper {
 public:
  KeyframeKeeper(const loop_metric::Parameters& parameters, const urban_nav_core::StereoCamera& camera);

  /// Goes on behind `run`, of which the views at `kept` (ascending) were kept.
  void goOn(const VoRun& run, const std::vector<urban_nav_core::StampNs>& kept);

  /// To be called for each frame with its row.
  std::optional<urban_nav_store::StoredKeyframe> process(const urban_nav_core::StereoPair& pair, const VoRow& row);

 private:
  loop_metric::KeyframeChoice choice_;
  loop_metric::KeyframeMaker maker_;
};

}  // namespace urban_nav
