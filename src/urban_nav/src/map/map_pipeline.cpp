// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_pipeline.hpp"

#include <algorithm>
#include <set>

#include "base/command_parameters.hpp"
#include "base/plot.hpp"
#include "map/lost_closures.hpp"
#include "map/map_division.hpp"
#include "map/map_report.hpp"
#include "map/output_files.hpp"
#include "map/run_totals.hpp"
#include "map/session_evaluation.hpp"
#include "map/session_order.hpp"
#include "map/session_reader.hpp"
#include "map/stage_selection.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

constexpr double kReportPeriod = 4.0;  // s

void printSource(const urban_nav_input::SourceInfo& info, Console& console) {
  const std::string size = std::to_string(info.camera.left.width) + "x" + std::to_string(info.camera.left.height);
  console.info(
      info.name + ": " + info.kind +
      (info.frames > 0 ? ", " + std::to_string(info.frames) + (info.has_images ? " stereo frames" : " sweeps") : "") +
      (info.has_images ? ", " + size : ""));
  for (const std::string& note : info.notes) console.info("  " + note);
}

/// One run of `map`: sessions are read, stages run, results are written.
class MapRun {
 public:
  MapRun(const MapOptions& options, AllStages stages, const ResultRecorder& record, Console& console)
      : context_(options, console),
        all_stages_(std::move(stages)),
        stages_(selectStages(all_stages_, options, console)),
        folder_(options.out),
        record_(record) {
    if (!options.truth.empty()) urban_nav_input::readTrajectory(options.truth);  // reports a bad file before the work
    if (!options.closures.empty())
      for (const urban_nav_core::ClosureRow& row : urban_nav_core::readClosures(options.closures))
        context_.closures.push_back(toMetricClosure(row));
    for (urban_nav_input::InputSession& input :
         urban_nav_input::findSessions(options.inputs, options.source.topics, options.source.sessions)) {
      context_.sessions.emplace_back();
      context_.sessions.back().input = std::move(input);
    }
  }

  /// Returns the names of the consistency tests that failed.
  std::vector<std::string> run() {
    RunCheckpoint checkpoint(context_.options, stages_, context_.sessions, folder_.file("session.db"),
                             context_.console);
    context_.store = &checkpoint.store();
    ClosurePoses accepted_before;
    addAcceptedClosures(*context_.store, accepted_before);
    readSessions(checkpoint);
    context_.joins = joinsSessions(context_.options, stages_);
    if (context_.joins) orderSessions(context_);
    context_.divides = canDivide(context_, stages_);
    context_.given = context_.closures;
    runStages();
    if (context_.joins)
      if (const std::string lost = lostClosuresWarning(*context_.store, accepted_before); !lost.empty())
        context_.console.warn(lost);
    context_.evaluations = evaluateSessions(context_);
    writeResults();
    if (record_ && !context_.options.mcap.empty()) recordResults();
    checkpoint.endRun();
    return failed_tests_;
  }

 private:
  void readSessions(RunCheckpoint& checkpoint) {
    std::vector<SessionReader> readers;
    for (std::size_t i = 0; i < context_.sessions.size(); ++i) {
      readers.emplace_back(context_, stages_, checkpoint, i);
      readers.back().openResumed();
    }
    nameSessions();
    for (std::size_t i = 0; i < readers.size(); ++i) {
      readers[i].open();
      printSource(context_.sessions[i].info, context_.console);
      if (i == 0 && !context_.options.so_far) {
        writeReport(0.0);
        context_.console.info("report: " + folder_.file("report.html") +
                              " (open it now; it is updated as stages finish)");
      }
      readers[i].read([this](double share) { updateReport(share); });
    }
  }

  /// Names all sessions, previous ones first, and replaces session numbers in the closures by names.
  void nameSessions() {
    const bool uses_previous =
        std::any_of(stages_.begin(), stages_.end(), [](const Stage* stage) { return stage->describe().uses_previous; });
    std::vector<urban_nav_store::SessionId> own_ids;
    std::vector<urban_nav_input::InputSession> inputs;
    for (const MapSession& session : context_.sessions) {
      own_ids.push_back(session.id);
      inputs.push_back(session.input);
    }
    if (uses_previous) context_.previous = readPreviousSessions(*context_.store, own_ids);
    context_.names = urban_nav_input::sessionNames(inputs, context_.previous.names);
    for (urban_nav_core::MetricClosure& closure : context_.closures)
      for (std::string* session : {&closure.a.session, &closure.b.session})
        *session = urban_nav_input::sessionMeant(*session, context_.names, context_.previous.names.size());
  }

  void runStages() {
    for (Stage* stage : stages_) {
      runStage(*stage);
      while (!context_.isFinal())
        for (Stage* again : stages_)
          if (isRepeatedByMap(again->describe().name)) runStage(*again);
    }
    context_.store->commit();
  }

  void runStage(Stage& stage) {
    if (const std::string missing = stage.missingInput(context_); !missing.empty()) {
      const Stage::Description description = stage.describe();
      if (description.listed && !context_.options.stages.empty())
        throw urban_nav_core::DataError("--stages " + description.name, "cannot be run: " + missing, "");
      context_.console.info("stage " + description.name + " left out: " + missing);
      return;
    }
    context_.store->commit();
    const Stage::Messages messages = stage.run(context_);
    for (const std::string& line : messages.info) context_.console.info(line);
    for (const std::string& line : messages.warnings)
      if (warned_.insert(line).second) context_.console.warn(line);
  }

  void updateReport(double share) {
    if (context_.options.so_far || usage_.wallSeconds() - reported_s_ <= kReportPeriod) return;
    writeReport(share);
    reported_s_ = usage_.wallSeconds();
  }

  void writeReport(double share) {
    const MapState state{context_, stages_, usage_, true, share};
    folder_.write("report.html", renderPage(mapPage(state, stageResults(state))));
  }

  void writeResults() {
    const MapOptions& options = context_.options;
    const double progress = options.so_far.value_or(1.0);
    const MapState state{context_, stages_, usage_, progress < 1.0, progress};
    const std::vector<StageResult> results = stageResults(state);
    for (const StageResult& result : results)
      failed_tests_.insert(failed_tests_.end(), result.failed_tests.begin(), result.failed_tests.end());
    writeOutputFiles(folder_, context_, all_stages_, stages_, results);
    folder_.write("report.html", renderPage(mapPage(state, results)));
    const std::string summary = mapSummary(state, results).print();
    folder_.write("summary.json", summary);
    if (!options.json.empty()) urban_nav_core::writeAtomically(options.json, summary);
    printTotals(state);
    context_.console.print(folder_.file("report.html") + "\n" + folder_.file("trajectory.tum") + "\n");
  }

  void recordResults() {
    context_.store->commit();
    const MapState state{context_, stages_, usage_, false, 1.0};
    const double memory_mb = context_.options.parameters.get(commandTable()).memory_mb;
    for (const std::string& path :
         record_(*context_.store, context_.options.mcap, memory_mb, stageFigures(state, stageResults(state))))
      context_.console.print(path + "\n");
  }

  void printTotals(const MapState& state) {
    const RunTotals extent = ownTotals(context_);
    const std::size_t sessions = context_.sessions.size();
    context_.console.info(std::to_string(extent.frames) + " frames, " +
                          urban_nav_core::formatNumber(extent.distance_m, 4) + " m" +
                          (sessions > 1 ? ", " + std::to_string(sessions) + " sessions" : "") + ", " +
                          urban_nav_core::formatNumber(realtimeFactor(state), 3) + " times real time");
  }

  Usage usage_;
  MapContext context_;
  const std::vector<std::unique_ptr<Stage>> all_stages_;
  const StageList stages_;  // those that this run has
  const OutputFolder folder_;
  const ResultRecorder& record_;
  std::vector<std::string> failed_tests_;
  std::set<std::string> warned_;  // by stages
  double reported_s_ = 0.0;       // when the report was written last
};

}  // namespace

std::vector<std::string> runMap(const MapOptions& options, AllStages stages, Console& console,
                                const ResultRecorder& record) {
  return MapRun(options, std::move(stages), record, console).run();
}

}  // namespace urban_nav
