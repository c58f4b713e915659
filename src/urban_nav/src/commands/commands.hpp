// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/command.hpp"

namespace urban_nav {

/// The subcommands (docs/files.md), each in a file of its name.
Command convertCommand();
Command deviceCommand();
Command disparityCommand();
Command doctorCommand();
Command evaluateCommand();
Command exportCommand();
Command icpCommand();
Command infoCommand();
Command labelsCommand();
Command mapCommand();
Command mergeCommand();
Command placesCommand();
Command relaxCommand();
Command simulateCommand();
Command whyCommand();

}  // namespace urban_nav
