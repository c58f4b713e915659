// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "map/session_pass.hpp"
#include "topics/lasers/panorama_pass.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace urban_nav {

/// Stores the sensor data of a session from which the map can be rendered without the recording: panoramas, and sweeps
/// of 3D LiDARs about every 0.25 m or 6 deg of travel, or every ten seconds at rest.
class SensorPass final : public SessionPass {
 public:
  SensorPass(MapContext& context, const Stage::SessionStart& start);
  void process(PassItem&) override {}
  void process(const urban_nav_ros::Panorama& panorama) override { panoramas_.process(panorama); }
  void process(const urban_nav_input::SweepInput& input) override;
  std::string checkpoint() override;

 private:
  /// Pose and time of the last stored sweep of a LiDAR.
  struct StoredSweep {
    std::string role;
    urban_nav_core::StampNs stamp = 0;
    std::optional<urban_nav_core::Pose> T_odom_base;
    void archive(urban_nav_core::Archive& archive) { archive(role, stamp, T_odom_base); }
  };
  /// State of the pass at the end of a bag.
  struct State {
    std::vector<StoredSweep> last;
    void archive(urban_nav_core::Archive& archive) { archive(last); }
  };
  /// Returns the last sweep of a LiDAR, inserted if missing.
  StoredSweep& lastPassFor(const urban_nav_input::SweepInput& input);

  urban_nav_store::Store& store_;
  MapSession& session_;
  PanoramaPass panoramas_;
  State state_;
};

}  // namespace urban_nav
