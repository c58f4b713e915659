// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "laser_mapper/depth_image_row.hpp"
#include "topics/lasers/lasers.hpp"
#include "topics/lasers/spaced_pass.hpp"
#include "urban_nav_ros/depth_image.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/lidar_sweep.hpp"
#include "urban_nav_store/tables/mounted_lidar.hpp"

namespace urban_nav {

using urban_nav_store::LidarSweep;
using urban_nav_store::MountedLidar;
using urban_nav_store::TableStore;

namespace {

std::string frameName(const urban_nav_input::SourceInfo& info, const std::string& role) {
  for (const urban_nav_input::InputStream& input : info.inputs)
    if (input.role == role) return input.frame;
  return role;
}

/// Stores sweeps of 3D LiDARs and images of depth cameras about every 0.25 m or 6 deg of travel, from which maps and
/// local clouds are rendered without the recording.
class SweepPass final : public SpacedPass {
 public:
  SweepPass(MapContext& context, const Stage::SessionStart& start)
      : SpacedPass("sweeps of a session", urban_nav_core::kSweepSpacing, context, start),
        is_for_map_(isForMap(context.options)) {}
  /// Returns whether images of depth cameras are stored, which only the map uses.
  static bool isForMap(const MapOptions& options) { return isRequested(options, "lasers") && options.localise.empty(); }

  void process(PassItem&) override {}
  void process(const urban_nav_input::DepthInput& input) override {
    const urban_nav_input::DepthCamera& camera = session().info.depth_cameras.at(input.camera);
    if (!is_for_map_ || input.stamp <= 0 || !takes(camera.role, input.stamp)) return;
    const urban_nav_ros::DepthPixels pixels =
        input.raw ? urban_nav_ros::toDepth(*input.raw) : urban_nav_ros::toDepth(*input.compressed);
    if (!pixels.fault.empty()) return addFault(camera.topic + ": " + pixels.fault);
    if (pixels.depth.cols != camera.pinhole.width || pixels.depth.rows != camera.pinhole.height)
      return addFault(camera.topic + ": an image has another size than the camera_info");
    urban_nav_store::DepthImage row = laser_mapper::depthImageRow(pixels.depth, camera.pinhole);
    row.session = session().id;
    row.role = camera.role;
    row.stamp = input.stamp;
    row.frame = camera.frame;
    row.T_base_camera = camera.T_base_camera;
    TableStore<urban_nav_store::DepthImage>(store()).put(row);
  }
  void process(const urban_nav_input::SweepInput& input) override {
    if (input.is_planar) return;  // stored as scans
    if (!hasStored(input.role))
      TableStore<MountedLidar>(store()).put(
          {session().id, input.role, frameName(session().info, input.role), input.T_base_lidar});
    if (!takes(input.role, input.sweep.reference)) return;
    TableStore<LidarSweep>(store()).put(
        {session().id, input.role, input.sweep.reference, LidarSweep::pack(input.sweep)});
  }

 private:
  void addFault(std::string fault) {
    SessionOdometry& odometry = *session().odometry;
    ++odometry.faults_total;
    if (odometry.faults.size() < kMaxFaults) odometry.faults.push_back(std::move(fault));
  }

  const bool is_for_map_;
};

class SweepsStage final : public Stage {
 public:
  Description describe() const override {
    Description description{"sweeps", "sweeps", false, false, false, {}};
    description.uses_sweeps = description.uses_depth = true;
    return description;
  }
  Selection select(const MapOptions& options) const override {
    const bool is_enabled = isRequested(options, "lasers") || !options.localise.empty() ||
                            (isRequested(options, "loops") && isRequested(options, "lo"));
    return {is_enabled, "neither lasers nor loops of laser odometry nor --localise", {}};
  }
  std::unique_ptr<SessionPass> beginSession(MapContext& context, const SessionStart& start) override {
    return std::make_unique<SweepPass>(context, start);
  }
};

}  // namespace

std::unique_ptr<Stage> makeSweepsStage() { return std::make_unique<SweepsStage>(); }

}  // namespace urban_nav
