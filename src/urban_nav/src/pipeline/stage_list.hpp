// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "stage/stage.hpp"

namespace urban_nav {

/// Stages in their order; not owned.
using StageList = std::vector<Stage*>;

/// Returns new objects of all stages of the suite, in the order in which they run. The only place that names them.
std::vector<std::unique_ptr<Stage>> makeStages();

/// Returns the words of --stages: those of makeStages() that are selectable.
std::vector<std::string> stageNames();

}  // namespace urban_nav
