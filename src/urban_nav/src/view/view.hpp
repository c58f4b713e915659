// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"

namespace urban_nav {

/// Returns the command view, which shows a store in the browser and edits it. `tables`: of the program's stages.
Command viewCommand(ParameterTables tables);

/// Returns the action teach of the command labels, which corrects labels in the browser.
Command labelsTeachAction();

}  // namespace urban_nav
