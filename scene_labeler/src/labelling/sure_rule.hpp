// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene_labeler/model/label_model.hpp"

namespace scene_labeler {

/// Decides which answers in a scene are unsure. The threshold is that of the model's cross-validation for its
/// precision. The more the scene differs from the training places, the higher is the precision that is required of the
/// threshold, because errors are more frequent there, and returns that are unlike all training samples are unsure.
/// Models without thresholds keep the fixed ones of their version.
class SureRule {
 public:
  /// Properties of a scene.
  struct Place {
    bool has_other_device = false;  ///< reflectance of another device than in training
    double share_unlike = 0.0;      ///< of PlaceNovelty
    double share_outside = 0.0;     ///< share of returns with features outside the training data
  };
  SureRule(const LabelModel& model, const Place& place);

  /// Returns whether an answer is unsure. `probability`: of the answer, as fused; `stated`: that in the results;
  /// `is_outside`: the features are outside the training data.
  bool isUnsure(float probability, float stated, bool is_outside) const;
  /// Returns whether sure answers must also be tested by PlaceNovelty::isNovel().
  bool testsNovelty() const { return tests_novelty_; }

 private:
  bool is_fixed_;             // thresholds of earlier versions
  bool is_outside_common_;    // then returns outside the training data need a higher probability; else they are unsure
  bool tests_novelty_ = false;
  float least_, least_outside_;
};

}  // namespace scene_labeler
