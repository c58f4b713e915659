// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scene_labeler/model/label_model.hpp"

namespace scene_labeler {

/// How frequent the classes are where the robot is. A model's probabilities are those of a return from anywhere on its
/// training drives; where gravel is everywhere and paving rare, what could be either is gravel. Frequencies are
/// estimated from the probabilities themselves by expectation maximisation (Saerens, Latinne and Decaestecker 2002),
/// over the returns of the last quarter of a minute. Half of their logarithm is used: neighbouring returns err
/// together. Not thread-safe.
class ClassFrequencies {
 public:
  /// A model that does not know the frequencies of its training (LabelModel::samples) leaves all as it is.
  explicit ClassFrequencies(const LabelModel& model);

  /// Corrects the log probabilities of some returns, one row of all classes each, to the frequencies of those before
  /// and of these. Rows whose `is_left_out` is 1 stay as they are and do not count: what a model says of a kind of
  /// place that it was not trained in (isNewPlace) is no measurement. Empty: none is left out.
  void correct(std::vector<float>& logs, const std::vector<std::uint8_t>& is_left_out = {});

 private:
  /// What these sums of probabilities add to the log probability of each class.
  std::vector<float> shifts(const std::vector<double>& sums) const;

  std::size_t classes_ = 0;
  std::vector<double> trained_;  // share of each class; empty if unknown
  std::vector<double> seen_;     // sum of the probabilities of each class
};

}  // namespace scene_labeler
