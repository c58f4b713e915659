// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "training/patch_fusion.hpp"

namespace scene_labeler {

/// Returns the wrong answers among held-out returns, fused over their patches as by the model, for each threshold.
/// Every site counts the same; the standard error is that of a ratio over sites (Cochran 1977, section 6.4). Empty with
/// fewer than two sites.
SureThresholds measureSureThresholds(const HeldOutPatches& held_out, const LabelModel& model);

}  // namespace scene_labeler
