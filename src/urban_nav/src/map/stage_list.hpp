// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "map/stage.hpp"

namespace urban_nav {

/// Stages of a run in their order; not owned.
using StageList = std::vector<Stage*>;
/// All stages of the program in their order.
using AllStages = std::vector<std::unique_ptr<Stage>>;
/// Returns new objects of all stages, for one run.
using StageFactory = std::function<AllStages()>;

/// Returns the words of --stages: the names of those stages that are selectable.
std::vector<std::string> stageNames(const AllStages& stages);

}  // namespace urban_nav
