// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "command_line/usage.hpp"
#include "evaluation/evaluation.hpp"
#include "input/sessions.hpp"
#include "pipeline/map_pipeline.hpp"
#include "pipeline/output_folder.hpp"
#include "stage/previous_sessions.hpp"
#include "stages/graph/graph_stage.hpp"
#include "stages/localization/localization_run.hpp"
#include "stages/loops/loops_stage.hpp"
#include "stages/vo/vo_stage.hpp"

namespace urban_nav {

/// What a run of `map` has made so far: what the report shows while it is at work.
struct MapOutcome {
  explicit MapOutcome(const MapRequest& asked) : request(asked), folder(asked.out) {}

  const MapRequest& request;
  OutputFolder folder;
  Usage usage;
  std::vector<std::unique_ptr<VoStage>> stages;   ///< one per session
  std::vector<SourceInfo> infos;                  ///< one per session
  EarlierSessions earlier;                        ///< of the store that the run goes on from, where it has a graph
  std::vector<std::string> session_names;         ///< as closures.csv has them: earlier ones, then those of this run
  std::optional<LoopsRun> loops;                  ///< when transforms of closures have been looked for
  std::vector<LocaliseRun> localised;             ///< one per session, where a map was given to find them in
  std::optional<GraphRun> graph;                  ///< when it is relaxed: of the earlier sessions, then of these
  std::optional<GraphRun> without_icp;            ///< relaxed over the closures by stereo alone, where there are others
  std::vector<std::optional<Evaluation>> before;  ///< as evaluations, by odometry alone; empty without a graph
  std::vector<std::optional<Evaluation>> evaluations;  ///< one per session, when all are finished; empty before
  double progress = 0.0;                               ///< of the session at work
};

/// The runs of the graph's sessions: earlier ones, then those of this run.
std::vector<const VoRun*> runsOfGraph(const MapOutcome& outcome);

/// report.html as things stand, marked as unfinished.
void writeReport(const MapOutcome& outcome);

/// stats.csv, summary.json and the finished report; compares with the truth where there is one, and says how it went.
void finishMap(MapOutcome& outcome, const std::vector<Session>& sessions, Console& console);

}  // namespace urban_nav
