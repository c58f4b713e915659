// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "topics/lasers/spaced_pass.hpp"

namespace urban_nav {

/// Stores panoramas of a session, at half the spacing of the views that colour the map, and the calibration of their
/// cameras, so that the map can be coloured without the recording. Omits cameras without calibration or extrinsics.
class PanoramaPass final : public SpacedPass {
 public:
  PanoramaPass(MapContext& context, const Stage::SessionStart& start);
  void process(const urban_nav_ros::Panorama& panorama) override;

 private:
  std::vector<std::optional<std::int64_t>> cameras_;  ///< numbers, in the order of a panorama's images
};

}  // namespace urban_nav
