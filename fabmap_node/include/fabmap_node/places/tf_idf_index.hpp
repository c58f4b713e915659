// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fabmap_node/model/chow_liu_tree.hpp"
#include "fabmap_node/places/word_postings.hpp"

namespace fabmap_node {

/// Ranks places by the cosine similarity of weighted words (Sivic and Zisserman, ICCV 2003), the common alternative to
/// likelihoods, for comparison. The weight of a word is -log p(z_q = 1), its inverse document frequency in training;
/// words of an observation count once. Const functions are thread-safe.
class TfIdfIndex {
 public:
  /// Takes the frequencies of words from a tree.
  explicit TfIdfIndex(const ChowLiuTree& tree);

  /// Adds a place, whose number is the previous size(). Requires words below the tree's size.
  void add(const WordSet& place);
  std::size_t size() const { return norms_.size(); }

  /// Writes the similarity of `query` to every place, 0 ... 1, into `result`, resized to size().
  void similarities(const WordSet& query, std::vector<double>& result) const;

 private:
  double norm(const WordSet& words) const;

  std::vector<double> weights_;  // per word
  std::vector<double> norms_;    // per place
  WordPostings postings_;
};

}  // namespace fabmap_node
