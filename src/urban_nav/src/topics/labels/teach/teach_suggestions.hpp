// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scene_labeler/labelling/labeler.hpp"
#include "topics/labels/teach/correction_list.hpp"
#include "topics/labels/teach/unit_kinds.hpp"

namespace urban_nav {

/// A unit whose correction is worth most among units with similar features.
struct TeachSuggestion {
  std::uint32_t point = 0;  ///< to click: the middle of the unit
  std::size_t units = 0;    ///< uncorrected units with similar features
  double area = 0.0;        ///< m2 of these
  double worth = 0.0;       ///< m2: sum of area times uncertainty of these, less where similar ones were corrected
  scene_labeler::SceneClass label = scene_labeler::SceneClass::None;   ///< answer at the unit
  scene_labeler::SceneClass second = scene_labeler::SceneClass::None;  ///< next class; None without another
  double probability = 0.0;                                            ///< of the answer
};

/// Returns where corrections are worth most, best first, at most `most`: one unit of each kind of units, by the sum of
/// area times uncertainty over the kind, divided by one more than the number of corrections in it. Uncertainty: one
/// less the probability of the answer, of which half counts for an unsure one. `corrected`: class per point, None
/// without a correction. Deterministic.
std::vector<TeachSuggestion> suggestCorrections(const TeachUnits& units, const UnitKinds& kinds,
                                                const scene_labeler::SceneLabels& answer,
                                                const std::vector<LabelCorrection>& corrections,
                                                const std::vector<scene_labeler::SceneClass>& corrected,
                                                std::size_t most);

}  // namespace urban_nav
