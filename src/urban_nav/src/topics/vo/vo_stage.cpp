// SPDX-License-Identifier: BSD-3-Clause
#include "topics/vo/vo.hpp"

#include <algorithm>

#include "base/plot.hpp"
#include "map/chain_g2o.hpp"
#include "map/odometry_source.hpp"
#include "map/odometry_store_writer.hpp"
#include "map/store_keys.hpp"
#include "topics/vo/vo_files.hpp"
#include "topics/vo/vo_recorder.hpp"
#include "topics/vo/vo_report.hpp"
#include "topics/vo/vo_run_state.hpp"
#include "topics/vo/vo_summary.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/motion_input.hpp"
#include "urban_nav_input/session/input_parameters.hpp"

namespace urban_nav {

using urban_nav_core::DataError;

namespace {

constexpr std::size_t kFaultsOnConsole = 10;  // while a session is read

void checkUsable(const VoRun& run) {
  const bool any = std::any_of(run.figures.begin(), run.figures.end(),
                               [](const VoFigures& each) { return each.statistics.features > 0; });
  if (any) return;
  const std::string first = !run.faults.empty()   ? "; the first fault: " + run.faults.front()
                            : !run.frames.empty() ? "; the first: " + run.frames.front().status.sentence
                                                  : "";
  throw DataError(run.input, "none of " + std::to_string(run.frames.size()) + " stereo frames could be used" + first,
                  "");
}

class VoPass final : public SessionPass {
 public:
  VoPass(MapContext& context, const Stage::SessionStart& start, VoRun& run)
      : console_(context.console),
        run_(run),
        is_levelled_(
            urban_nav_core::toMotionChoice(context.options.parameters.get(urban_nav_input::inputTable()).motion_input)
                .gyroscope),
        recorder_(makeRecorder(context, start)),
        writer_(*context.store, context.sessions[start.session].id, kVoStage, kVoStream),
        faults_reported_(run_.faults.size()) {}

  void process(PassItem& item) override {
    item.odometry = &recorder_.process(item.input);
    recorder_.correctRight(item.input.assembled);
    for (; faults_reported_ < std::min(run_.faults.size(), kFaultsOnConsole); ++faults_reported_)
      console_.warn(run_.faults[faults_reported_]);
  }
  void flush() override { writer_.write(run_); }
  std::string checkpoint() override { return recorder_.state(); }
  void finish(const PassEnd& end) override {
    const bool was_turned = recorder_.finish(end, is_levelled_);
    checkUsable(run_);
    if (was_turned) writer_.rewrite(run_);
    else writer_.write(run_);
    writer_.writeForces(run_);
    for (const std::string& fault : end.faults) console_.warn(fault);
  }
  std::string finished() override { return packVoRun(run_); }

 private:
  VoRecorder makeRecorder(MapContext& context, const Stage::SessionStart& start) {
    const swf_vo::Parameters& parameters = context.options.parameters.get(swf_vo::table());
    const urban_nav_input::SourceInfo& info = context.sessions[start.session].info;
    if (start.checkpoint) return VoRecorder(parameters, info, run_, *start.checkpoint);
    return VoRecorder(parameters, info, run_);
  }

  Console& console_;
  VoRun& run_;
  bool is_levelled_;
  VoRecorder recorder_;
  OdometryStoreWriter writer_;
  std::size_t faults_reported_;
};

/// Returns the most frequent problem of the run, with the sentence of its first frame; empty without one.
std::string mostFrequentProblem(const std::vector<const VoRun*>& runs, const VoSummary& summary) {
  if (summary.reason_counts.empty()) return {};
  const auto most = std::max_element(summary.reason_counts.begin(), summary.reason_counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  std::string counts, sentence;
  for (const char* name : {"DEGRADED", "LOST", "RECOVERED"}) {
    const std::int64_t count = summary.status_counts.at(name);
    if (count > 0) counts += (counts.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  }
  for (const VoRun* run : runs)
    for (const OdometryFrame& row : run->frames)
      if (sentence.empty() && swf_vo::toString(static_cast<swf_vo::Reason>(row.status.reason)) == most->first)
        sentence = row.status.sentence;
  return counts + " of " + std::to_string(summary.frames) +
         " frames; most often: " + (sentence.empty() ? most->first : sentence);
}

class VoStage final : public Stage {
 public:
  Description describe() const override {
    return {"vo", kVoStage, true, false, false, {"graph#.g2o", "landmarks#.ply", "stats.csv"}};
  }
  void addTables(ParameterSet& parameters) const override { parameters.add(swf_vo::table()); }
  std::vector<urban_nav_core::Setting> passSettings(const ParameterSet& parameters) const override {
    return parameters.settings(swf_vo::table().stage());
  }
  Selection select(const MapOptions&) const override { return {true, "", {}}; }

  std::unique_ptr<SessionPass> beginSession(MapContext& context, const SessionStart& start) override {
    if (!usesStereo(chooseOdometry(context.options, context.sessions[start.session].info))) return nullptr;
    return std::make_unique<VoPass>(context, start, restart(context, start.session, VoRun()));
  }
  bool restoreSession(MapContext& context, std::size_t session, std::string_view finished) override {
    std::optional<VoRun> run = unpackVoRun(finished);
    if (!run) return false;
    const urban_nav_input::SourceInfo& info = context.sessions[session].info;
    run->input = info.name;
    run->camera = info.camera;
    run->T_base_camera = info.T_base_camera;
    restart(context, session, std::move(*run));
    return true;
  }

  Messages run(MapContext& context) override {
    context.trajectories = odometryTrajectories(context.runs(), context.sessionsKept());
    const std::string problem = mostFrequentProblem(runs(), summarise(runs()));
    return {{}, problem.empty() ? std::vector<std::string>() : std::vector<std::string>{problem}};
  }

  StageResult result(const MapContext& context) const override {
    StageResult stage_result;
    const std::vector<const VoRun*> of_sessions = runs();
    if (of_sessions.empty() && !context.sessions.empty() && isByLaser(context)) return stage_result;
    const VoSummary summary = summarise(of_sessions, context.options.parameters.get(swf_vo::table()));
    stage_result.method = "Visual odometry";
    stage_result.tiles = {
        {urban_nav_core::formatNumber(summary.ms_median, 3), "ms", "median time in the filter", Grade::Plain}};
    stage_result.verdicts = voVerdicts(summary);
    for (std::size_t i = 0; i < of_sessions.size(); ++i) {
      const std::size_t number = context.number(i);
      const bool compared = number < context.evaluations.size() && context.evaluations[number].map;
      for (Section& section : voSections(*of_sessions[i], !compared)) {
        if (context.sessions.size() > 1) {
          section.id += std::to_string(i + 1);
          section.title += " (session " + std::to_string(i + 1) + ")";
        }
        stage_result.sections.push_back({report_place::kOdometry, std::move(section)});
      }
      if (!runs_[i]) continue;
      const std::string suffix = fileSuffix(number);
      const VoRun& run = *of_sessions[i];
      const bool is_fused = context.sessions[i].odometry->source == OdometrySource::Both;
      if (!context.relaxed && !is_fused)
        stage_result.files.push_back({"graph" + suffix + ".g2o", [&run] { return chainG2o(run); }});
      stage_result.files.push_back({"landmarks" + suffix + ".ply", [&run] { return landmarksPly(run); }});
    }
    stage_result.data_faults = summary.warnings;
    std::vector<const SessionOdometry*> chosen;
    for (std::size_t i = 0; i < of_sessions.size(); ++i) chosen.push_back(context.sessions[i].odometry.get());
    stage_result.files.push_back({"stats.csv", [of_sessions, chosen] { return statsCsv(of_sessions, chosen); }});
    stage_result.summary = toJson(summary);
    return stage_result;
  }

 private:
  /// Returns whether the odometry of all sessions that were begun is that of a laser.
  static bool isByLaser(const MapContext& context) {
    return std::all_of(context.sessions.begin(), context.sessions.end(),
                       [](const MapSession& session) { return session.odometry->source == OdometrySource::Laser; });
  }
  /// Sets `run` as the odometry of a session.
  VoRun& restart(MapContext& context, std::size_t session, VoRun run) {
    runs_.resize(context.sessions.size());
    runs_[session] = std::make_shared<VoRun>(std::move(run));
    context.sessions[session].odometry = runs_[session];
    return *runs_[session];
  }
  /// Returns the odometry of this run's sessions; empty for those that have not been begun.
  std::vector<const VoRun*> runs() const {
    static const VoRun none;
    std::vector<const VoRun*> all;
    for (const std::shared_ptr<VoRun>& run : runs_) all.push_back(run ? run.get() : &none);
    return all;
  }

  std::vector<std::shared_ptr<VoRun>> runs_;  // of the sessions of this run
};

}  // namespace

std::unique_ptr<Stage> makeVoStage() { return std::make_unique<VoStage>(); }

}  // namespace urban_nav
