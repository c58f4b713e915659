// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "scene_labeler/classes.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace scene_labeler {

/// Binary tree over feature codes, with one value per class at each leaf.
struct LabelTree {
  struct Node {
    std::uint8_t feature = 0, threshold = 0;  ///< codes up to the threshold go left
    bool missing_right = false;               ///< branch of code 0
    std::int16_t left = -1, right = -1;       ///< index of a node; negative: leaf -1 - index
  };
  std::vector<Node> nodes;    ///< children after their parent; empty: only leaf 0
  std::vector<float> leaves;  ///< per leaf and class

  std::size_t findLeaf(const std::uint8_t* codes) const;
  void archive(urban_nav_core::Archive& archive);
};

/// Sum of trees: boosted trees, or a forest whose leaves are divided by the number of trees.
struct TreeEnsemble {
  std::vector<float> base;  ///< value per class, to which the trees add
  std::vector<LabelTree> trees;

  std::size_t classes() const { return base.size(); }
  /// Sums the leaves reached by a row of codes; `scores`: one value per class.
  void evaluate(const std::uint8_t* codes, float* scores) const;
  /// `features`: number of columns of the codes, for validation of nodes while reading.
  void archive(urban_nav_core::Archive& archive, std::size_t features);
};

}  // namespace scene_labeler
