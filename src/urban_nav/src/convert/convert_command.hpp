// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"

namespace urban_nav {

/// Returns the command convert: turns folders of other projects into bags.
Command convertCommand();

}  // namespace urban_nav
