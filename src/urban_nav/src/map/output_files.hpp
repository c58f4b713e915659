// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "map/output_folder.hpp"
#include "map/stage_list.hpp"

namespace urban_nav {

/// Writes the files of a run besides report and summary: trajectories and closures, which the stages hand to each
/// other, and the files of each stage. Removes files that an earlier run has left in the folder and this one does not
/// make; those of previous sessions stay if this run leaves them as they are. `all`: also the stages that this run
/// leaves out.
void writeOutputFiles(const OutputFolder& folder, const MapContext& context,
                      const std::vector<std::unique_ptr<Stage>>& all, const StageList& selected,
                      const std::vector<StageResult>& results);

}  // namespace urban_nav
