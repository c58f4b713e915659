// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/console.hpp"
#include "map/map_options.hpp"
#include "map/result_recorder.hpp"
#include "map/stage_list.hpp"

namespace urban_nav {

/// Runs the requested `stages` on the inputs and writes trajectories, closures, report, summary and the files of each
/// stage into the output folder, and with MapOptions::mcap their results by `record`. Continues an interrupted run with
/// the same options. Returns the names of the consistency tests that failed. Throws UserError for bad options,
/// DataError if the inputs are not usable.
std::vector<std::string> runMap(const MapOptions& options, AllStages stages, Console& console,
                                const ResultRecorder& record = {});

}  // namespace urban_nav
