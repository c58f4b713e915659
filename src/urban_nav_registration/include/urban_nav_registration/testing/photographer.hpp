// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_registration/keyframe/keyframe_extractor.hpp"

namespace urban_nav_registration::testing {

using urban_nav_core::Pose;

using urban_nav_core::testing::makeCamera;

/// Renders stereo pairs of a scene from given poses.
class Photographer {
 public:
  explicit Photographer(urban_nav_core::testing::Scene scene, double noise = 1.0) : scene_(std::move(scene)) {
    options_.noise = noise;
  }

  /// Sets the camera of the following pairs.
  void setCamera(const urban_nav_core::testing::RenderCamera& camera) { options_.camera = camera; }

  urban_nav_core::StereoCamera camera() const { return makeCamera(options_.camera); }
  /// `gain`: of the exposure. The noise differs between pairs.
  urban_nav_core::testing::StereoFrame take(const Pose& T_world_left, double gain = 1.0) {
    options_.seed = ++taken_;
    options_.gain = [gain](double) { return gain; };
    urban_nav_core::testing::RenderedSequence sequence(scene_, urban_nav_core::testing::standing(T_world_left),
                                                       options_);
    return sequence.frame(0);
  }
  Keyframe keyframe(const Pose& T_world_left, double gain = 1.0, int points = 500) {
    const auto frame = take(T_world_left, gain);
    return KeyframeExtractor(camera(), points)
        .extract({"", static_cast<urban_nav_core::StampNs>(taken_)}, frame.pair());
  }

 private:
  urban_nav_core::testing::Scene scene_;
  urban_nav_core::testing::SequenceOptions options_;
  std::uint32_t taken_ = 0;
};

}  // namespace urban_nav_registration::testing
