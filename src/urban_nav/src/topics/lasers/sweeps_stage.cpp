// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/lasers.hpp"
#include "topics/lasers/spaced_pass.hpp"
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

/// Stores sweeps of 3D LiDARs about every 0.25 m or 6 deg of travel, from which maps and local clouds are rendered
/// without the recording.
class SweepPass final : public SpacedPass {
 public:
  SweepPass(MapContext& context, const Stage::SessionStart& start)
      : SpacedPass("sweeps of a session", urban_nav_core::kSweepSpacing, context, start) {}

  void process(PassItem&) override {}
  void process(const urban_nav_input::SweepInput& input) override {
    if (input.is_planar) return;  // stored as scans
    if (!hasStored(input.role))
      TableStore<MountedLidar>(store()).put(
          {session().id, input.role, frameName(session().info, input.role), input.T_base_lidar});
    if (!takes(input.role, input.sweep.reference)) return;
    TableStore<LidarSweep>(store()).put(
        {session().id, input.role, input.sweep.reference, LidarSweep::pack(input.sweep)});
  }
};

class SweepsStage final : public Stage {
 public:
  Description describe() const override {
    Description description{"sweeps", "sweeps", false, false, false, {}};
    description.uses_sweeps = true;
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
