// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scene_labeler/classes.hpp"
#include "topics/labels/teach/teach_units.hpp"

namespace urban_nav {

/// A class given to a unit by a person, and to the units around it.
struct LabelCorrection {
  std::uint32_t point = 0;                                            ///< a point of the unit
  float radius = 0.0F;                                                ///< m around the point; 0: its unit alone
  scene_labeler::SceneClass label = scene_labeler::SceneClass::None;  ///< None: takes classes back
};

bool operator==(const LabelCorrection& a, const LabelCorrection& b);

/// Corrections in their order, of which the last ones may be undone. Later ones prevail.
class CorrectionList {
 public:
  CorrectionList() = default;
  /// `base`: classes per point from before the first correction, as another program wrote them; empty: none.
  explicit CorrectionList(std::vector<scene_labeler::SceneClass> base) : base_(std::move(base)) {}

  void add(const LabelCorrection& correction);
  /// Take back the last correction, or the last undo. Return false without one.
  bool undo();
  bool redo();
  bool canUndo() const { return active_ > 0; }
  bool canRedo() const { return active_ < all_.size(); }
  /// Returns the corrections that are not undone, in their order.
  std::vector<LabelCorrection> active() const { return {all_.begin(), all_.begin() + static_cast<int>(active_)}; }
  const std::vector<scene_labeler::SceneClass>& base() const { return base_; }
  /// Returns the class of each point; None without one.
  std::vector<scene_labeler::SceneClass> labels(const TeachUnits& units) const;

 private:
  std::vector<scene_labeler::SceneClass> base_;
  std::vector<LabelCorrection> all_;
  std::size_t active_ = 0;
};

}  // namespace urban_nav
