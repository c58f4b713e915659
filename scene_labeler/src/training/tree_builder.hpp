// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "scene_labeler/model/feature_bins.hpp"
#include "scene_labeler/training/tree_training.hpp"

namespace scene_labeler {

/// Derivatives of the loss: per sample, one first and one second derivative per class, interleaved.
using Derivatives = std::vector<float>;

/// Grows one tree at a time from histograms of the derivatives over the codes, splitting the leaf with the largest gain
/// first.
class TreeBuilder {
 public:
  TreeBuilder(const CodedSamples& samples, const TreeSettings& settings);

  /// `drawn`: samples of this tree, ascending, may be repeated. `draws_per_node`: features are drawn for each node
  /// instead of the whole tree. Values of leaves are minus the Newton step, times `step`.
  LabelTree build(const Derivatives& derivatives, const std::vector<std::uint32_t>& drawn, bool draws_per_node,
                  float step, std::mt19937_64& random);

 private:
  struct Split {
    double gain = 0.0;
    std::uint8_t feature = 0, threshold = 0;
    bool missing_right = false;
  };
  struct Leaf {
    std::vector<std::uint32_t> samples;
    std::vector<float> histogram;  // per feature and code: derivatives and the weight
    std::vector<double> total;
    Split split;
    std::int16_t parent = -1;
    bool is_right = false;
  };
  std::vector<float> makeHistogram(const std::vector<std::uint32_t>& samples) const;
  std::vector<double> sumHistogram(const std::vector<float>& histogram) const;
  Split bestSplit(const Leaf& leaf, const std::vector<std::uint8_t>& features) const;
  Split bestSplitBy(const Leaf& leaf, std::uint8_t feature) const;
  double scoreTotal(const double* total) const;
  void divide(Leaf& leaf, Leaf& other) const;
  std::vector<std::uint8_t> drawFeatures(std::mt19937_64& random) const;

  const CodedSamples& samples_;
  const TreeSettings& settings_;
  std::size_t width_;                  // of a histogram entry
  std::vector<std::uint8_t> columns_;  // codes, by feature
  const Derivatives* derivatives_ = nullptr;
  std::vector<std::uint8_t> tree_features_;
};

}  // namespace scene_labeler
