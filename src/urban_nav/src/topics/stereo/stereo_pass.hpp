// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "map/stage.hpp"
#include "topics/stereo/stereo_matcher.hpp"
#include "urban_nav_registration/keyframe/keyframe_selector.hpp"

namespace urban_nav {

/// Selects the keyframes of dense stereo by distance, angle and time, according to its parameters.
class StereoKeyframeSelector {
 public:
  explicit StereoKeyframeSelector(const dense_stereo::Parameters& parameters);
  /// Continues after a keyframe.
  void keep(urban_nav_core::StampNs stamp, const urban_nav_core::Pose& T_odom_base);
  /// Returns true if the frame is a keyframe. Call for each frame in order of time.
  bool select(urban_nav_core::StampNs stamp, const urban_nav_core::Pose& T_odom_base);

 private:
  urban_nav_registration::KeyframeSelector selector_;
  urban_nav_core::StampNs interval_;
  std::optional<urban_nav_core::StampNs> last_;
};

/// Dense stereo's part of the reading pass: matches keyframes, and writes ground and points to the store.
class StereoPass final : public SessionPass {
 public:
  /// `run`: of this session; must outlive the pass.
  StereoPass(MapContext& context, const Stage::SessionStart& start, StereoRun& run);

  void process(PassItem& item) override;
  std::string checkpoint() override;
  void finish(const PassEnd&) override { writeAll(); }
  std::string finished() override { return packStereoRun(run_); }

  static std::string packStereoRun(StereoRun& run);
  /// Throws DataError if the bytes are not those of a run.
  static StereoRun unpackStereoRun(std::string_view bytes);

 private:
  void put(StereoOutput output);
  void writeAll();

  urban_nav_store::Store& store_;
  StereoRun& run_;
  StereoKeyframeSelector selector_;
  StereoMatcher matcher_;
  std::int64_t selected_ = 0;
};

}  // namespace urban_nav
