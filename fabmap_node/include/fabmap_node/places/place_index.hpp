// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fabmap_node/model/likelihood.hpp"
#include "fabmap_node/places/word_postings.hpp"

namespace fabmap_node {

/// Inverted index over places of one observation each: computes log likelihoods of a query at every place without a
/// pass over the vocabulary (FAB-MAP 2.0: Cummins and Newman, RSS 2009, section IV), equal to logLikelihoodPlain() up
/// to rounding.
///
/// Each place stores the likelihood of an empty query. Only words whose combination (z_q, z_parent) differs from (0,
/// 0), that is the words of the query and their children, are then corrected along their postings.
///
/// Memory: that of WordPostings, and 8 bytes per place. Not thread-safe while add() runs; const functions are.
class PlaceIndex {
 public:
  /// The table must outlive the index.
  explicit PlaceIndex(const LikelihoodTable& table);

  /// Adds a place, whose number is the previous size(). Requires words below the table's size.
  void add(const WordSet& place);
  std::size_t size() const { return empty_query_.size(); }

  /// Writes log p(query | place) in nats for every place into `result`, resized to size(). Time: O(words of the query,
  /// their children, and the postings of both, plus size()).
  void logLikelihoods(const WordSet& query, std::vector<double>& result) const;

 private:
  const LikelihoodTable& table_;
  double nothing_seen_ = 0.0;        // log likelihood of an empty query at an empty place
  std::vector<double> empty_query_;  // per place: contribution of its words to nothing_seen_
  WordPostings postings_;
};

}  // namespace fabmap_node
