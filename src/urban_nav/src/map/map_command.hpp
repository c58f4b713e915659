// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"
#include "map/map_options.hpp"
#include "map/result_recorder.hpp"
#include "map/stage_list.hpp"

namespace urban_nav {

/// Returns the options of a run of `map` with these arguments. Throws UserError for those that are not allowed.
MapOptions readMapOptions(const Arguments& arguments, const AllStages& stages);

/// Returns the command map, which runs these stages. `record`: writes the file of --mcap.
Command mapCommand(StageFactory make_stages, ResultRecorder record = {});

}  // namespace urban_nav
