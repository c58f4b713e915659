// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/lasers.hpp"

#include "base/plot.hpp"
#include "laser_mapper/sensors.hpp"
#include "map/session_fixes.hpp"
#include "topics/lasers/calibration_report.hpp"
#include "topics/lasers/lasers_report.hpp"
#include "topics/lasers/lasers_run.hpp"
#include "topics/lasers/panorama_pass.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

class LasersStage final : public Stage {
 public:
  explicit LasersStage(SharedCalibrations along_odometry) : along_odometry_(std::move(along_odometry)) {}

  Description describe() const override {
    Description description{"lasers", "laser_mapper", true, false, false, {"map#.ply", "quality#.csv"}};
    description.uses_colour = true;
    return description;
  }
  void addTables(ParameterSet& parameters) const override { parameters.add(laser_mapper::table()); }
  Selection select(const MapOptions& options) const override {
    const bool is_enabled = options.localise.empty() && isRequested(options, "lasers");
    if (options.calibrate && !is_enabled)
      throw urban_nav_core::UserError("--calibrate", "stage lasers does not run",
                                      "lasers among --stages, and without --localise");
    if (!options.localise.empty()) return {false, "not with --localise", {}};
    if (!is_enabled) return {false, "not in --stages", {}};
    return {true, "", {}};
  }

  std::unique_ptr<SessionPass> beginSession(MapContext& context, const SessionStart& start) override {
    storeFixes(context, start.session);                                                   // export --crs needs them
    laser_mapper::forgetCalibration(*context.store, context.sessions[start.session].id);  // of an earlier run
    return std::make_unique<PanoramaPass>(context, start);
  }

  std::string missingInput(const MapContext& context) const override {
    std::string missing = "no sessions";
    for (const urban_nav_store::SessionId& id : context.ids()) {
      missing = laser_mapper::missingMeasurements(*context.store, id);
      if (missing.empty()) break;
    }
    return missing;
  }

  Messages run(MapContext& context) override {
    run_ = runLasers(context.options.parameters.get(laser_mapper::table()), context, *along_odometry_);
    const laser_mapper::BeamCounts beams = run_->beams();
    Messages messages{calibrationSentences(*run_), lasersWarnings(*run_)};
    std::string points;
    for (const auto& [sensor, count] : run_->pointsBySensor())
      points += (points.empty() ? "" : ", ") + std::to_string(count) + " of " + sensor;
    messages.info.push_back("lasers: " + std::to_string(run_->points()) + " points" +
                            (points.empty() ? "" : " (" + points + ")") + ", " + std::to_string(beams.all) +
                            " beams, " + std::to_string(run_->chunksRendered()) + " chunks rendered in " +
                            urban_nav_core::formatNumber(run_->seconds, 3) + " s");
    return messages;
  }

  StageResult result(const MapContext&) const override {
    StageResult made;
    if (!run_) return made;
    made.method = "laser map";
    made.tiles = lasersTiles(*run_);
    made.sections.push_back({report_place::kMap, lasersSection(*run_)});
    made.data_faults = lasersWarnings(*run_);
    for (const LaserMapRun& map : run_->maps) {
      if (map.points > 0) made.written_files.push_back(map.file);
      made.files.push_back({"quality" + fileSuffix(map.map) + ".csv", map.quality_csv.empty()
                                                                          ? std::function<std::string()>()
                                                                          : [&map] { return map.quality_csv; }});
    }
    made.summary = toJson(*run_);
    return made;
  }

 private:
  const SharedCalibrations along_odometry_;
  std::optional<LasersRun> run_;
};

}  // namespace

std::unique_ptr<Stage> makeLasersStage(SharedCalibrations along_odometry) {
  return std::make_unique<LasersStage>(std::move(along_odometry));
}

}  // namespace urban_nav
