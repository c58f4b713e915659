// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"

namespace urban_nav {

/// Actions of `urban_nav places` other than replay.
Command placesTrainAction();
Command placesQueryAction();
Command placesEvaluateAction();

}  // namespace urban_nav
