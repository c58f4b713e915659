// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scene_labeler/model/label_model.hpp"

namespace scene_labeler {

/// Adapts to the frequencies of classes around the robot. The probabilities of a model have the class prior of its
/// training drives; where gravel is everywhere and paving rare, an ambiguous return is gravel. Frequencies are
/// estimated from the probabilities by expectation maximisation (Saerens, Latinne and Decaestecker 2002), over the
/// returns of the last quarter of a minute. Half of their logarithm is applied, because errors of adjacent returns are
/// correlated. Not thread-safe.
class ClassFrequencies {
 public:
  /// A model without the frequencies of its training data (LabelModel::samples) leaves probabilities unchanged.
  explicit ClassFrequencies(const LabelModel& model);

  /// Corrects the log probabilities of returns, one row of all classes each, to the frequencies of these and earlier
  /// returns. Rows whose `is_left_out` is 1 are unchanged and not counted, since the answers in a kind of place without
  /// training data (isNewPlace) are unreliable. Empty: none is left out.
  void correct(std::vector<float>& logs, const std::vector<std::uint8_t>& is_left_out = {});

 private:
  /// Returns the correction of each class's log probability for these sums of probabilities.
  std::vector<float> shifts(const std::vector<double>& sums) const;

  std::size_t classes_ = 0;
  std::vector<double> trained_;  // share of each class; empty if unknown
  std::vector<double> seen_;     // sum of the probabilities of each class
};

}  // namespace scene_labeler
