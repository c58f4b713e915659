// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "fabmap_node/model/chow_liu_tree.hpp"

namespace fabmap_node {

/// Detector model p(z = 1 | e) of Newman et al. 2009, section 3.1: probability of detecting a word if the scene element
/// exists, and if it does not. 0 <= present_given_absent < present_given_exists < 1.
struct Detector {
  double present_given_exists = 0.39;
  double present_given_absent = 0.0;
};

/// Dependence model of words.
enum class Dependence { ChowLiu, Naive };

/// Log likelihoods of one word, log p(z_q | z_parent, L) in nats, for the four combinations of the query (z_q,
/// z_parent) and three kinds of place: the word was absent there, present there, or the place is unknown (mean field:
/// p(e_q | L) = p(e_q), eq. 6).
///
/// With a = p(z) p(!z | e) p(!z | z_parent) and b = p(!z) p(z | e) p(z | z_parent), each summand over e is
/// p(e | L) b / (a + b) (Cummins and Newman 2008, eq. 14-18); naive Bayes: p(e | L) p(z | e).
class LikelihoodTable {
 public:
  /// Index of a combination: 2 z_q + z_parent.
  using Combination = unsigned;
  struct WordTerms {
    std::array<double, 4> absent, present, unknown;
  };

  LikelihoodTable(const ChowLiuTree& tree, const Detector& detector, Dependence dependence);

  const WordTerms& word(Word q) const { return words_[q]; }
  std::size_t size() const { return words_.size(); }
  const std::vector<Word>& parents() const { return parents_; }
  /// Returns the words whose parent is q, except the root itself.
  const std::vector<Word>& children(Word q) const { return children_[q]; }
  Word root() const { return root_; }

 private:
  std::vector<WordTerms> words_;
  std::vector<Word> parents_;
  std::vector<std::vector<Word>> children_;
  Word root_ = 0;
};

/// Returns the log likelihood of `query` at a place with one observation `place`, by direct summation over all words,
/// O(V). Reference for the index.
double logLikelihoodPlain(const LikelihoodTable& table, const WordSet& query, const WordSet& place);

/// Returns the log likelihood of `query` at an unknown place (mean field, eq. 6), O(V).
double logLikelihoodUnknown(const LikelihoodTable& table, const WordSet& query);

}  // namespace fabmap_node
