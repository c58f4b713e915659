// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lo/lo.hpp"

#include <algorithm>

#include "map/chain_g2o.hpp"
#include "map/odometry_source.hpp"
#include "map/odometry_store_writer.hpp"
#include "map/store_keys.hpp"
#include "topics/lo/lo_files.hpp"
#include "topics/lo/lo_recorder.hpp"
#include "topics/lo/lo_report.hpp"
#include "topics/lo/lo_run_state.hpp"
#include "topics/lo/lo_summary.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

constexpr std::size_t kLoFaultsOnConsole = 10;

void checkUsable(const LoRun& run) {
  const bool any = std::any_of(run.figures.begin(), run.figures.end(),
                               [](const LoFigures& each) { return each.statistics.patches > 0; });
  if (any) return;
  std::string why;
  for (const OdometryFrame& frame : run.frames)
    if (why.empty() && frame.status.reason != 0) why = "; the first: " + frame.status.sentence;
  throw urban_nav_core::DataError(
      run.input, "none of " + std::to_string(run.frames.size()) + " sweeps could be registered" + why, "");
}

class LoPass final : public SessionPass {
 public:
  /// `is_alone`: the laser is the only odometry, which is then stored.
  LoPass(MapContext& context, const Stage::SessionStart& start, LoRun& run, bool is_alone)
      : console_(context.console), run_(run), recorder_(makeRecorder(context, start)) {
    if (is_alone) writer_.emplace(*context.store, context.sessions[start.session].id, kLoStage, kLoStream);
  }

  void process(PassItem&) override {}
  void process(const urban_nav_input::SweepInput& sweep) override { recorder_.process(sweep); }
  void flush() override {
    if (writer_) writer_->write(run_);
  }
  std::string checkpoint() override { return recorder_.state(); }
  void finish(const PassEnd& end) override {
    recorder_.finish(end);
    if (writer_) {
      checkUsable(run_);
      writer_->write(run_);
      writer_->writeForces(run_);
    }
    for (std::size_t i = 0; i < std::min(run_.faults.size(), kLoFaultsOnConsole); ++i) console_.warn(run_.faults[i]);
  }
  std::string finished() override { return packLoRun(run_); }

 private:
  LoRecorder makeRecorder(MapContext& context, const Stage::SessionStart& start) {
    const laser_odometry::Parameters& parameters = context.options.parameters.get(laser_odometry::table());
    const urban_nav_input::SourceInfo& info = context.sessions[start.session].info;
    if (start.checkpoint) return LoRecorder(parameters, info, run_, *start.checkpoint);
    return LoRecorder(parameters, info, run_);
  }

  Console& console_;
  LoRun& run_;
  LoRecorder recorder_;
  std::optional<OdometryStoreWriter> writer_;
};

class LoStage final : public Stage {
 public:
  Description describe() const override {
    Description description{"lo", kLoStage, true, false, false, {"graph#.g2o", "sweeps#.csv"}};
    description.uses_sweeps = true;
    return description;
  }
  void addTables(ParameterSet& parameters) const override { parameters.add(laser_odometry::table()); }
  std::vector<urban_nav_core::Setting> passSettings(const ParameterSet& parameters) const override {
    return parameters.settings(laser_odometry::table().stage());
  }
  Selection select(const MapOptions& options) const override {
    if (options.odometry == OdometryOption::Stereo) return {false, "--odometry stereo", {}};
    const bool is_asked = options.odometry == OdometryOption::Laser || options.odometry == OdometryOption::Both;
    return {is_asked || isRequested(options, "lo"), "not in --stages", {}};
  }

  std::unique_ptr<SessionPass> beginSession(MapContext& context, const SessionStart& start) override {
    const OdometrySource source = chooseOdometry(context.options, context.sessions[start.session].info);
    if (!usesLaser(source)) return nullptr;
    return std::make_unique<LoPass>(context, start, restart(context, start.session, LoRun()),
                                    source == OdometrySource::Laser);
  }
  bool restoreSession(MapContext& context, std::size_t session, std::string_view finished) override {
    std::optional<LoRun> run = unpackLoRun(finished);
    if (!run) return false;
    const urban_nav_input::SourceInfo& info = context.sessions[session].info;
    run->input = info.name;
    if (info.has_images) run->camera = info.camera;
    run->T_base_camera = info.T_base_camera;
    restart(context, session, std::move(*run));
    return true;
  }

  std::string missingInput(const MapContext&) const override {
    return runs().empty() ? "no sweeps of a 3D LiDAR or a horizontal planar laser, or odometry by stereo" : "";
  }

  Messages run(MapContext& context) override {
    context.trajectories = odometryTrajectories(context.runs(), context.sessionsKept());
    const LoSummary summary = summariseLo(runs());
    Messages messages;
    messages.info.push_back("lo: " + std::to_string(summary.sweeps) + " sweeps, " +
                            urban_nav_core::formatNumber(summary.ms_median, 3) + " ms a sweep");
    messages.warnings = summary.reason_sentences;
    if (summary.degenerate > 0)
      messages.info.push_back("lo: " + std::to_string(summary.degenerate) + " of " + std::to_string(summary.sweeps) +
                              " sweeps leave directions of the motion free");
    return messages;
  }

  StageResult result(const MapContext& context) const override {
    StageResult result;
    if (runs().empty()) return result;
    const LoSummary summary = summariseLo(runs());
    result.method = "Laser odometry";
    result.tiles = {{urban_nav_core::formatNumber(summary.ms_median, 3), "ms", "median time of a sweep", Grade::Plain}};
    result.verdicts = loVerdicts(summary);
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!runs_[i]) continue;
      for (Section& section : loSections(*runs_[i])) {
        if (context.sessions.size() > 1) {
          section.id += std::to_string(i + 1);
          section.title += " (session " + std::to_string(i + 1) + ")";
        }
        result.sections.push_back({report_place::kOdometry, std::move(section)});
      }
      const std::string suffix = fileSuffix(context.number(i));
      const LoRun& run = *runs_[i];
      if (!context.relaxed && !context.sessions[i].by_laser)
        result.files.push_back({"graph" + suffix + ".g2o", [&run] { return chainG2o(run); }});
      result.files.push_back({"sweeps" + suffix + ".csv", [&run] { return sweepsCsv(run); }});
    }
    result.data_faults = summary.warnings;
    result.summary = toJson(summary);
    return result;
  }

 private:
  /// Sets `run` as the odometry of a session.
  LoRun& restart(MapContext& context, std::size_t session, LoRun run) {
    runs_.resize(context.sessions.size());
    runs_[session] = std::make_shared<LoRun>(std::move(run));
    MapSession& of = context.sessions[session];
    if (chooseOdometry(context.options, of.info) == OdometrySource::Both) of.by_laser = runs_[session];
    else of.odometry = runs_[session];
    return *runs_[session];
  }
  /// Returns the laser odometry of the sessions of this run that have one.
  std::vector<const LoRun*> runs() const {
    std::vector<const LoRun*> all;
    for (const std::shared_ptr<LoRun>& run : runs_)
      if (run) all.push_back(run.get());
    return all;
  }

  std::vector<std::shared_ptr<LoRun>> runs_;  // of the sessions of this run; null: odometry by stereo
};

}  // namespace

std::unique_ptr<Stage> makeLoStage() { return std::make_unique<LoStage>(); }

}  // namespace urban_nav
