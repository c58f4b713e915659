// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/page.hpp"
#include "base/usage.hpp"
#include "map/result_recorder.hpp"
#include "map/stage_list.hpp"

namespace urban_nav {

/// A run of `map` at any time.
struct MapState {
  const MapContext& context;
  const StageList& stages;
  const Usage& usage;
  bool running = true;    ///< the report is marked as unfinished and refreshes itself
  double progress = 0.0;  ///< 0...1, while running
};

/// Returns the results of all stages, in their order.
std::vector<StageResult> stageResults(const MapState& state);

/// Returns the page of report.html: results of the stages, compared with ground truth if there is any.
Page mapPage(const MapState& state, const std::vector<StageResult>& results);

/// Returns summary.json: figures of the run, and the object of each stage under its key.
Json mapSummary(const MapState& state, const std::vector<StageResult>& results);

/// Returns the figures of the stages, for diagnostics.
std::vector<StageFigures> stageFigures(const MapState& state, const std::vector<StageResult>& results);

/// Returns seconds of data per second of the run.
double realtimeFactor(const MapState& state);

}  // namespace urban_nav
