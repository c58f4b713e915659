// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"

namespace urban_nav {

/// Returns the command evaluate: compares a trajectory with ground truth.
Command evaluateCommand();

}  // namespace urban_nav
