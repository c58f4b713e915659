// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "map/session_odometry.hpp"
#include "urban_nav_core/sequence/stereo_assembler.hpp"
#include "urban_nav_registration/keyframe/keyframe_extractor.hpp"
#include "urban_nav_registration/keyframe/keyframe_selector.hpp"
#include "urban_nav_registration/parameters.hpp"
#include "urban_nav_store/keyframe_store.hpp"

namespace urban_nav {

/// Extracts the keyframes of a session for loops and localization, selected by KeyframeChoice. Extraction runs
/// concurrently to the caller; keyframes are returned in order, each when the second one after it is selected, so the
/// output does not depend on timing. Equal runs give equal keyframes, also if resumed after a bag.
class KeyframeWriter {
 public:
  KeyframeWriter(const urban_nav_registration::Parameters& parameters, const urban_nav_core::StereoCamera& camera,
                 bool one_thread);

  /// Continues after `run`, of which the keyframes at `stored` (ascending) are in the store.
  void resume(const SessionOdometry& run, const std::vector<urban_nav_core::StampNs>& stored);

  /// Adds a frame with its row. Returns a finished keyframe of an earlier frame, if there is one.
  std::optional<urban_nav_store::StoredKeyframe> process(const urban_nav_core::StereoPairWithMotion& frame,
                                                         const OdometryFrame& row);
  /// Returns the next keyframe that process() has not returned; blocks until it is extracted. nullopt: no more.
  std::optional<urban_nav_store::StoredKeyframe> next();

 private:
  urban_nav_registration::KeyframeSelector selector_;
  std::shared_ptr<const urban_nav_registration::KeyframeExtractor> extractor_;
  std::launch launch_;
  std::deque<std::future<urban_nav_store::StoredKeyframe>> made_;
};

}  // namespace urban_nav
