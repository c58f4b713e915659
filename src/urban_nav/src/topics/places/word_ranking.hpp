// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "topics/places/place_query.hpp"
#include "topics/places/place_truth.hpp"

namespace urban_nav {

/// Scores of earlier places by words only.
enum class WordScoring {
  ChowLiu,     ///< log likelihood ratio to a new place per word, words dependent as in the tree
  NaiveBayes,  ///< log likelihood ratio with independent words
  TfIdf        ///< cosine similarity of weighted words
};
/// "Chow-Liu tree", "naive Bayes", "tf-idf".
const char* toString(WordScoring scoring);

/// Returns the best earlier place of each usable observation outside the mask (ns), by its words only.
std::vector<RankedMatch> rankByWords(const fabmap_node::PlaceModel& model, const PlaceRecording& recording,
                                     WordScoring scoring, urban_nav_core::StampNs mask);

/// Entry of a confusion matrix.
struct WordProbability {
  std::size_t row = 0;
  std::ptrdiff_t place_row = -1;  ///< -1: a new place
  double probability = 0.0;
};
/// Returns the probabilities above `least` of earlier places and of a new one, given the words of each observation
/// (Newman et al. 2009, eq. 4-7): Chow-Liu tree, the new place sampled, 0.9 of the prior on the new place and the rest
/// equally on the others. The probabilities of one observation sum to 1, including those below `least`.
std::vector<WordProbability> wordProbabilities(const fabmap_node::PlaceModel& model, const PlaceRecording& recording,
                                               urban_nav_core::StampNs mask, double least = 0.01);

}  // namespace urban_nav
