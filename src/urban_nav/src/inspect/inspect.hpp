// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"

namespace urban_nav {

/// Return the commands that read recordings and session stores: what they hold, their defects, their content in other
/// formats, several of them as one, and why a closure has its verdict.
Command infoCommand();
Command doctorCommand();
Command exportCommand();
Command mergeCommand();
Command whyCommand();

}  // namespace urban_nav
