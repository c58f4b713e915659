// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "topics/lasers/spaced_pass.hpp"

namespace urban_nav {

/// Stores panoramas of a session and images of its other cameras that colour the map, at half the spacing of the views
/// that colour it, and the calibration of their cameras, so that the map can be coloured without the recording. Omits
/// panoramic cameras without calibration or extrinsics.
class PanoramaPass final : public SpacedPass {
 public:
  PanoramaPass(MapContext& context, const Stage::SessionStart& start);
  void process(const urban_nav_ros::Panorama& panorama) override;
  void process(const urban_nav_input::ColourInput& input) override;

 private:
  std::vector<std::optional<std::int64_t>> cameras_;  ///< numbers, in the order of a panorama's images
};

}  // namespace urban_nav
