// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scene_labeler/classes.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace scene_labeler {

/// Binary tree over codes of features, with one value for each class at each leaf.
struct LabelTree {
  struct Node {
    std::uint8_t feature = 0, threshold = 0;  ///< codes up to the threshold go left
    bool missing_right = false;               ///< where code 0 goes
    std::int16_t left = -1, right = -1;       ///< index of a node; negative: leaf -1 - index
  };
  std::vector<Node> nodes;    ///< children after their parent; empty: leaf 0 alone
  std::vector<float> leaves;  ///< leaf by leaf, one value for each class

  std::size_t findLeaf(const std::uint8_t* codes) const;
  void archive(urban_nav_core::Archive& archive);
};

/// Sum of trees: boosted trees, or a forest whose leaves are divided by the number of trees.
struct TreeEnsemble {
  std::vector<float> base;  ///< one value for each class, to which the trees add
  std::vector<LabelTree> trees;

  std::size_t classes() const { return base.size(); }
  /// Adds up the leaves that a row of codes falls into: `scores` of one value for each class.
  void evaluate(const std::uint8_t* codes, float* scores) const;
  /// `features`: columns of the codes, against which nodes are checked when reading.
  void archive(urban_nav_core::Archive& archive, std::size_t features);
};

}  // namespace scene_labeler
