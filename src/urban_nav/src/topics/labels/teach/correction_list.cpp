// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/teach/correction_list.hpp"

namespace urban_nav {

using scene_labeler::SceneClass;

bool operator==(const LabelCorrection& a, const LabelCorrection& b) {
  return a.point == b.point && !(a.radius < b.radius) && !(b.radius < a.radius) && a.label == b.label;
}

void CorrectionList::add(const LabelCorrection& correction) {
  all_.resize(active_);
  all_.push_back(correction);
  ++active_;
}

bool CorrectionList::undo() {
  if (!canUndo()) return false;
  --active_;
  return true;
}

bool CorrectionList::redo() {
  if (!canRedo()) return false;
  ++active_;
  return true;
}

std::vector<SceneClass> CorrectionList::labels(const TeachUnits& units) const {
  std::vector<SceneClass> labels = base_;
  labels.resize(units.points(), SceneClass::None);
  for (const LabelCorrection& correction : active())
    for (const std::uint32_t unit : units.near(correction.point, correction.radius))
      for (const std::uint32_t point : units.members(unit)) labels[point] = correction.label;
  return labels;
}

}  // namespace urban_nav
