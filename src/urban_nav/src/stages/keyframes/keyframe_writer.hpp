// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "loop_metric/keyframe.hpp"
#include "loop_metric/keyframe_choice.hpp"
#include "loop_metric/parameters.hpp"
#include "stages/vo/vo_stage.hpp"
#include "urban_nav_core/sequence/stereo_assembler.hpp"
#include "urban_nav_store/keyframe_store.hpp"

namespace urban_nav {

/// The views of a session that are kept for closures and localisation, as KeyframeChoice has it. They are made beside the caller's work, and handed out in
/// order, each when the second one behind it is chosen, so that what is written does not depend on how fast they were. The same run gives the same views, also where
/// it goes on behind a bag.
class KeyframeKeeper {
 public:
  KeyframeKeeper(const loop_metric::Parameters& parameters, const urban_nav_core::StereoCamera& camera,
                 bool one_thread);

  /// Goes on behind `run`, of which the views at `kept` (ascending) were kept.
  void goOn(const VoRun& run, const std::vector<urban_nav_core::StampNs>& kept);

  /// To be called for each frame with its row. A view that is done, of an earlier frame.
  std::optional<urban_nav_store::StoredKeyframe> process(const urban_nav_core::StereoPairWithMotion& frame,
                                                         const VoRow& row);
  /// The next one that was not handed out; empty where none is left.
  std::optional<urban_nav_store::StoredKeyframe> next();

 private:
  loop_metric::KeyframeChoice choice_;
  std::shared_ptr<const loop_metric::KeyframeMaker> maker_;
  std::launch launch_;
  std::deque<std::future<urban_nav_store::StoredKeyframe>> made_;
};

}  // namespace urban_nav
