// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map/output_folder.hpp"
#include "map/stage_list.hpp"

namespace urban_nav {

/// Writes the files of a run except report and summary: trajectories, closures and the files of each stage. Removes
/// files of an earlier run that this run does not write; keeps those of previous sessions that it does not change.
/// `all`: all stages, including those that do not run.
void writeOutputFiles(const OutputFolder& folder, const MapContext& context,
                      const std::vector<std::unique_ptr<Stage>>& all, const StageList& selected,
                      const std::vector<StageResult>& results);

}  // namespace urban_nav
