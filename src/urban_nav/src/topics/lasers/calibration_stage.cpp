// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/lasers.hpp"

#include "topics/lasers/lasers_run.hpp"

namespace urban_nav {

namespace {

class CalibrationStage final : public Stage {
 public:
  explicit CalibrationStage(SharedCalibrations calibrations) : calibrations_(std::move(calibrations)) {}

  Description describe() const override { return {"calibration", "calibration", false, false, false, {}}; }
  void addTables(ParameterSet& parameters) const override { parameters.add(laser_mapper::table()); }
  Selection select(const MapOptions& options) const override {
    return {options.calibrate && options.localise.empty() && isRequested(options, "lasers"), "without --calibrate", {}};
  }

  Messages run(MapContext& context) override {
    const laser_mapper::Parameters& parameters = context.options.parameters.get(laser_mapper::table());
    const std::vector<urban_nav_store::SessionId> ids = context.ids();
    Messages messages;
    for (std::size_t s = 0; s < ids.size(); ++s) {
      if (context.isPrevious(s) || context.store->scans().lasers(ids[s]).empty()) continue;
      calibrations_->push_back(calibrateSession(parameters, s, context));
      messages.info.push_back("calibration of " + context.names[s] + " along odometry: " +
                              (calibrations_->back().found.isAdopted() ? "adopted" : "as stated"));
    }
    return messages;
  }

 private:
  const SharedCalibrations calibrations_;
};

}  // namespace

std::unique_ptr<Stage> makeCalibrationStage(SharedCalibrations calibrations) {
  return std::make_unique<CalibrationStage>(std::move(calibrations));
}

}  // namespace urban_nav
