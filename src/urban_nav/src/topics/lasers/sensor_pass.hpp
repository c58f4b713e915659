// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "map/session_pass.hpp"
#include "topics/lasers/panorama_pass.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace urban_nav {

/// Stores the sensor data of a session from which the map can be rendered without the recording: sweeps of 3D LiDARs
/// about every 0.25 m or 6 deg of travel, panoramas at half the spacing of the views that colour the map, and both
/// every ten seconds at rest.
class SensorPass final : public SessionPass {
 public:
  SensorPass(MapContext& context, const Stage::SessionStart& start);
  void process(PassItem&) override {}
  void process(const urban_nav_ros::Panorama& panorama) override;
  void process(const urban_nav_input::SweepInput& input) override;
  std::string checkpoint() override;

 private:
  /// Pose and time of the last stored sweep of a LiDAR, or panorama.
  struct LastStored {
    std::string role;
    urban_nav_core::StampNs stamp = 0;
    std::optional<urban_nav_core::Pose> T_odom_base;
    void archive(urban_nav_core::Archive& archive) { archive(role, stamp, T_odom_base); }
  };
  /// State of the pass at the end of a bag.
  struct State {
    std::vector<LastStored> last;
    void archive(urban_nav_core::Archive& archive) { archive(last); }
  };
  /// Returns the last stored data of a role; null without any.
  LastStored* findLast(const std::string& role);
  /// Returns whether data of a role are stored: the first, and those after so much motion or a long rest. Counts them
  /// as stored if so.
  bool takes(const std::string& role, urban_nav_core::StampNs stamp, double distance, double angle);

  urban_nav_store::Store& store_;
  MapSession& session_;
  PanoramaPass panoramas_;
  State state_;
};

}  // namespace urban_nav
