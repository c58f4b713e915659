// SPDX-License-Identifier: BSD-3-Clause
#include "stages/lasers/calibration_stage.hpp"

#include "stages/lasers/lasers_run.hpp"

namespace urban_nav {

namespace {

class CalibrationStage final : public Stage {
 public:
  Description describe() const override { return {"calibration", "calibration", false, false, false, {}}; }
  void addTables(ParameterSet& parameters) const override { parameters.add(laser_mapper::table()); }
  Selection select(const MapOptions& options) const override {
    return {options.calibrate && options.localise.empty() && isRequested(options, "lasers"), "without --calibrate", {}};
  }

  Messages run(MapContext& context) override {
    const laser_mapper::Parameters& parameters = context.options.parameters.get(laser_mapper::table());
    const std::vector<urban_nav_store::SessionId> ids = context.ids();
    Messages messages;
    for (std::size_t s = context.previous.runs.size(); s < ids.size(); ++s) {
      if (context.store->scans().lasers(ids[s]).empty()) continue;
      context.calibrations.push_back(calibrateSession(parameters, s, context));
      messages.info.push_back("calibration of " + context.names[s] + " along odometry: " +
                              (context.calibrations.back().found.isAdopted() ? "adopted" : "as stated"));
    }
    return messages;
  }
};

}  // namespace

std::unique_ptr<Stage> makeCalibrationStage() { return std::make_unique<CalibrationStage>(); }

}  // namespace urban_nav
