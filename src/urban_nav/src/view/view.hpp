// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"

namespace urban_nav {

/// Returns the command view, which shows a store in the browser and edits it. `tables`: of the program's stages.
Command viewCommand(ParameterTables tables);

}  // namespace urban_nav
