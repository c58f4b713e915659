// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "topics/labels/labels.hpp"

namespace urban_nav {

/// Actions of `urban_nav labels` other than train.
Command labelsApplyAction(const OdometryRunner& run_odometry);
Command labelsEvaluateAction(const OdometryRunner& run_odometry);

}  // namespace urban_nav
