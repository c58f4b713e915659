// SPDX-License-Identifier: BSD-3-Clause
#include "laser_sessions.hpp"

#include <filesystem>

#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/laser_scan.hpp"

namespace urban_nav::bench {

void putLaserSession(const std::string& bag, const urban_nav_store::SessionId& id, const std::string& name,
                     urban_nav_store::Store& store) {
  store.sessions().put(urban_nav_store::Session{id, name, "", "", 1, true});
  urban_nav_input::Recording recording(bag);
  const urban_nav_ros::StaticTransforms transforms = recording.transforms();
  for (const char* topic : {"/laser_left/scan", "/laser_right/scan"}) {
    urban_nav_input::RecordedMessages scans = recording.messages({topic});
    bool is_placed = false;
    while (const auto each = scans.next()) {
      const auto message = each->as<sensor_msgs::LaserScan>();
      const std::string& frame = message->header.frame_id;
      if (!is_placed)
        store.sessions().put(
            id, urban_nav_store::Extrinsic{frame, *transforms.lookup(urban_nav_core::frames::kBaseLink, frame)});
      is_placed = true;
      if (const auto scan = urban_nav_ros::toPlanarScan(*message))
        store.scans().put(id, frame, urban_nav_core::toScan(*scan));
    }
  }
  store.commit();
}

urban_nav_core::Trajectory trueTrajectory(const std::string& bag) {
  const std::filesystem::path path(bag);
  return urban_nav_core::readTum((path.parent_path() / (path.stem().string() + ".truth") / "trajectory.tum").string());
}

}  // namespace urban_nav::bench
