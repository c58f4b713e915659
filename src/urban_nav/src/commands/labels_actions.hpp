// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/command.hpp"

namespace urban_nav {

/// Actions of `urban_nav labels` beside train.
Command labelsApplyAction();
Command labelsEvaluateAction();

}  // namespace urban_nav
