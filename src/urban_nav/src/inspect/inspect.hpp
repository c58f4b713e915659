// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"

namespace urban_nav {

/// Return the commands that read recordings and session stores: contents, defects, export, merging, and explanation of
/// verdicts on closures.
Command infoCommand();
Command doctorCommand();
Command exportCommand();
Command mergeCommand();
Command whyCommand();

}  // namespace urban_nav
