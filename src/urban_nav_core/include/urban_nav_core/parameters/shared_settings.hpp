// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/parameters/sources.hpp"

namespace urban_nav_core {

/// Returns a message for each of `names`, parameters common to several stages, that has different values in two stages.
/// `settings`: of each stage.
std::vector<std::string> differingValues(const std::vector<const std::vector<Setting>*>& settings,
                                         const std::vector<std::string>& names);

}  // namespace urban_nav_core
