// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scene_labeler/model/tree_ensemble.hpp"

namespace scene_labeler {

/// Samples for trees: codes of features, index of the class among the model's classes, and weights.
struct CodedSamples {
  std::size_t features = 0, classes = 0;
  std::vector<std::uint8_t> codes;   ///< per sample
  std::vector<std::uint8_t> labels;  ///< one per sample, below `classes`
  std::vector<float> weights;        ///< one per sample, positive
  /// One per sample for continueBoosted(), 1: the present answer is the target, whatever its label. Empty: none.
  std::vector<std::uint8_t> is_anchor;

  std::size_t size() const { return labels.size(); }
};

/// Settings of boosted trees and of forests.
struct TreeSettings {
  std::size_t trees = 120;
  std::size_t leaves = 24;      ///< largest number, of each tree
  double learning_rate = 0.1;   ///< boosted trees only
  double regularisation = 1.0;  ///< added to the weight of a leaf
  double least_weight = 8.0;    ///< least total weight of the samples of a leaf
  double feature_share = 0.5;   ///< of the features, drawn for each tree (boosted) or node (forest)
  double sample_share = 0.7;    ///< of the samples, drawn for each tree
};

/// Trains gradient boosted trees on the multinomial deviance (Friedman 2001), with all classes in each tree and second
/// derivatives as in Chen and Guestrin 2016. Deterministic for any number of threads.
TreeEnsemble trainBoosted(const CodedSamples& samples, const TreeSettings& settings, std::uint64_t seed);

/// Adds settings.trees boosted trees to an ensemble of the same classes, whose trees are kept. Their leaves are at most
/// 0.5, since the ensemble may be confidently wrong on samples. Deterministic for any number of threads.
TreeEnsemble continueBoosted(TreeEnsemble ensemble, const CodedSamples& samples, const TreeSettings& settings,
                             std::uint64_t seed);

/// Trains a random forest (Breiman 2001), whose scores are shares of votes.
TreeEnsemble trainForest(const CodedSamples& samples, const TreeSettings& settings, std::uint64_t seed);

}  // namespace scene_labeler
