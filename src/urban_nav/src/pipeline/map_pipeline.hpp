// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/console.hpp"
#include "stage/map_options.hpp"

namespace urban_nav {

/// Runs the stages over the inputs and writes trajectories, closures, report, summary and the files of each stage into
/// the output folder. Continues an interrupted run with the same options. Throws UserError for bad options, DataError
/// if the inputs are not usable.
void runMap(const MapOptions& options, Console& console);

}  // namespace urban_nav
