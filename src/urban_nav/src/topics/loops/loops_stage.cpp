// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/loops.hpp"

#include <algorithm>

#include "base/plot.hpp"
#include "map/closure_notes.hpp"
#include "topics/loops/cloud_candidates.hpp"
#include "topics/loops/loops_report.hpp"
#include "topics/loops/loops_run.hpp"
#include "topics/loops/stored_sessions.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

namespace {

class LoopsStage final : public Stage {
 public:
  Description describe() const override { return {"loops", "loop_metric", true, true, true, {}}; }
  void addTables(ParameterSet& parameters) const override {
    parameters.add(urban_nav_registration::table());
    parameters.add(loop_metric::table());
  }
  Selection select(const MapOptions& options) const override {
    if (!options.localise.empty()) return {false, "not with --localise", {}};
    if (!isRequested(options, "loops")) return {false, "not in --stages", {}};
    return {true, "", closureNotes(options, true)};
  }

  Messages run(MapContext& context) override {
    const std::vector<const SessionOdometry*> runs = context.runs();
    const std::vector<urban_nav_store::SessionId> ids = context.ids();
    std::vector<CandidateSession> sessions;
    for (std::size_t i = 0; i < runs.size(); ++i) sessions.push_back({context.names[i], ids[i], runs[i]});
    CandidateMeasurer measurer;
    measurer.camera = context.lastCamera().value_or(urban_nav_registration::MountedCamera());  // of none: no views
    measurer.stores = {context.store->path()};
    measurer.sessions = storedSessions(sessions, *context.store, measurer.camera);
    measurer.parameters = context.options.parameters.get(loop_metric::table());
    measurer.parameters.registration = context.options.parameters.get(urban_nav_registration::table());
    addProposed(proposeByClouds(context, measurer), "clouds", context.closures);
    LoopsRun run = runLoops(measurer, context.closures, context.measured, context.console);
    if (run_ && run_->candidates > 0) addTimes(*run_, run);
    run_ = std::move(run);
    context.closures = run_->closures;
    if (context.divides)
      for (const urban_nav_core::MetricClosure& closure : run_->measured)
        context.measured.insert_or_assign({closure.a, closure.b}, closure);
    if (run_->candidates == 0) return {};
    return {
        {"loops: " + std::to_string(run_->candidates) + " candidates, " + std::to_string(run_->accepted_stereo) +
         " accepted by stereo, " + std::to_string(run_->accepted_icp) + " by ICP, " + std::to_string(run_->rejected) +
         " rejected; " + urban_nav_core::formatNumber(run_->ms_median, 3) + " ms each"},
        run_->warnings};
  }

  StageResult result(const MapContext& context) const override {
    StageResult made;
    if (!run_) return made;
    made.summary = toJson(*run_);
    if (run_->candidates == 0) return made;
    made.verdicts = loopsVerdicts(*run_);
    made.sections.push_back({report_place::kClosures, loopsSection(*run_, context)});
    return made;
  }

 private:
  /// Adds the times of a run over larger groups, which measured most candidates.
  static void addTimes(const LoopsRun& earlier, LoopsRun& run) {
    run.ms += earlier.ms;
    run.ms_median = earlier.ms_median;
    run.ms_p99 = std::max(run.ms_p99, earlier.ms_p99);
  }

  std::optional<LoopsRun> run_;
};

}  // namespace

std::unique_ptr<Stage> makeLoopsStage() { return std::make_unique<LoopsStage>(); }

}  // namespace urban_nav
