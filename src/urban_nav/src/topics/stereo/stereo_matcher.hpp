// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <future>
#include <memory>
#include <optional>

#include "dense_stereo/near_scene.hpp"
#include "topics/stereo/stereo_run.hpp"
#include "urban_nav_input/session/source.hpp"
#include "urban_nav_store/tables/depth_view.hpp"
#include "urban_nav_store/tables/ground_view.hpp"
#include "urban_nav_store/tables/near_points.hpp"

namespace urban_nav {

/// Output of dense stereo for a keyframe: a row of the run, two of the store, and a picture.
struct StereoOutput {
  StereoKeyframe keyframe;
  urban_nav_store::GroundView ground;
  std::optional<urban_nav_store::NearPoints> points;  ///< for sessions with tilted planar lasers, to fill their map
  std::optional<urban_nav_store::DepthView> view;     ///< for other sessions, to build their map
  std::optional<StereoPicture> picture;
};

/// Matches the keyframes of a session concurrently to the caller. Outputs are returned in order, each when the second
/// keyframe after it is added, so they do not depend on timing.
class StereoMatcher {
 public:
  StereoMatcher(const dense_stereo::Parameters& parameters, const urban_nav_input::SourceInfo& info,
                const std::string& session, bool one_thread);

  /// Adds a keyframe. `number`: of the keyframe. Returns the output of an earlier one, if there is one.
  std::optional<StereoOutput> add(const urban_nav_core::StereoPairWithMotion& frame, std::int64_t number,
                                  bool with_picture);
  /// Returns the next output that add() has not returned; blocks until it is done. nullopt: no more.
  std::optional<StereoOutput> next();

 private:
  static constexpr std::size_t kWorkers = 2;
  struct Setting;

  std::shared_ptr<const Setting> setting_;
  std::array<std::shared_ptr<dense_stereo::NearSceneEstimator>, kWorkers> estimators_;
  std::size_t added_ = 0;
  std::launch launch_;
  std::deque<std::future<StereoOutput>> pending_;
};

}  // namespace urban_nav
