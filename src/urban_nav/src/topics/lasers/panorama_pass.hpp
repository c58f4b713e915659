// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map/context.hpp"
#include "map/session_pass.hpp"
#include "map/stage.hpp"

namespace urban_nav {

/// Stores the panoramas of a session and the calibration of their cameras, so that the map can be coloured without the
/// recording. Omits cameras without calibration or extrinsics.
class PanoramaPass final : public SessionPass {
 public:
  PanoramaPass(MapContext& context, const Stage::SessionStart& start);
  void process(PassItem&) override {}
  void process(const urban_nav_ros::Panorama& panorama) override;

 private:
  urban_nav_store::Store& store_;
  const urban_nav_store::SessionId id_;
  std::vector<std::optional<std::int64_t>> cameras_;  ///< numbers, in the order of a panorama's images
};

}  // namespace urban_nav
