// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fabmap_node/model/word_set.hpp"

namespace fabmap_node {

/// Tree-structured approximation of the joint distribution of words (Chow and Liu 1968; Newman et al. 2009, section
/// 3.2). Element q of each vector belongs to word q. Probabilities lie strictly between 0 and 1.
struct ChowLiuTree {
  std::vector<Word> parent;              ///< the root is its own parent
  std::vector<double> p;                 ///< p(z_q = 1)
  std::vector<double> p_parent_present;  ///< p(z_q = 1 | z_parent = 1); at the root p(z_q = 1)
  std::vector<double> p_parent_absent;   ///< p(z_q = 1 | z_parent = 0); at the root p(z_q = 1)

  std::size_t size() const { return parent.size(); }
};

/// Returns the mutual information of two words in nats, rounded to single precision: joint frequencies as counted,
/// marginals 0.98 n/N + 0.01, as defined by openFABMAP (Glover et al., ICRA 2012). It may be slightly negative. `both`,
/// `first`, `second`: number of the `total` observations with both words, the first, the second.
float mutualInformation(std::size_t both, std::size_t first, std::size_t second, std::size_t total);

/// Learns the maximum spanning tree of mutual information and its probabilities, each 0.98 n/N + 0.01 (0.01 if the
/// condition never holds). The root is the most frequent word. Ties are resolved in favour of the word that joins
/// first, then of the lower number, so the result is unique. Time: O(V^2 + sum of squared observation sizes); memory:
/// O(V + size of the observations).
/// `progress` is called repeatedly with the share of the time elapsed, and finally with 1.
/// Requires at least one observation and words below vocabulary_size. Throws UserError otherwise.
ChowLiuTree learnChowLiuTree(const WordSets& training, const std::function<void(double share)>& progress = {});

/// Returns the sum of mutualInformation() over the edges of a tree, in nats.
double totalInformation(const ChowLiuTree& tree, const WordSets& training);

/// Throws UserError with `name` unless the parents form one tree that contains every word, with one root, and all
/// probabilities lie in (0, 1).
void checkTree(const ChowLiuTree& tree, const std::string& name);

}  // namespace fabmap_node
