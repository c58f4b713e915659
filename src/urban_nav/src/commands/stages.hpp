// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/parameter_set.hpp"
#include "map/stage_list.hpp"

namespace urban_nav {

/// Returns new objects of all stages of the suite, in the order in which they run. The only list of the stages.
AllStages makeStages();

/// Adds the parameter tables of all stages, in their order.
void addStageTables(ParameterSet& parameters);

}  // namespace urban_nav
