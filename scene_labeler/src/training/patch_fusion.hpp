// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene_labeler/model/label_model.hpp"

namespace scene_labeler {

/// Log probabilities of held-out returns with their patches.
struct HeldOutPatches {
  HeldOutScores points;                ///< calibrated log probabilities
  std::vector<std::uint32_t> patches;  ///< one per return; no_patch for none
  std::vector<std::uint16_t> sites;    ///< one per return: number of its fold
};

/// Estimates the correlation of errors within patches, and calibrates the fused scores, by the likelihood of the
/// returns' true classes.
void fitPatchFusion(const HeldOutPatches& held_out, LabelModel& model);

/// Returns the log probabilities of the returns as the model labels them: those with a patch are fused over it.
HeldOutScores fusedAsByModel(const HeldOutPatches& held_out, const LabelModel& model);

}  // namespace scene_labeler
