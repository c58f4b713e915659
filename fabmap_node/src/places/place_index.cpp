// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/places/place_index.hpp"

#include <algorithm>
#include <map>

namespace fabmap_node {
namespace {

/// Returns the words whose combination differs from (0, 0), with their combinations, ascending by word.
std::map<Word, LikelihoodTable::Combination> activeWords(const LikelihoodTable& table, const WordSet& query) {
  std::map<Word, LikelihoodTable::Combination> active;
  for (const Word q : query) {
    active[q] |= 2u;
    for (const Word child : table.children(q)) active[child] |= 1u;
    if (q == table.root()) active[q] |= 1u;
  }
  return active;
}

}  // namespace

PlaceIndex::PlaceIndex(const LikelihoodTable& table) : table_(table), postings_(table.size()) {
  for (Word q = 0; q < table.size(); ++q) nothing_seen_ += table.word(q).absent[0];
}

void PlaceIndex::add(const WordSet& place) {
  double sum = 0.0;
  for (const Word q : place) sum += table_.word(q).present[0] - table_.word(q).absent[0];
  empty_query_.push_back(sum);
  postings_.add(place);
}

void PlaceIndex::logLikelihoods(const WordSet& query, std::vector<double>& result) const {
  double at_empty_place = nothing_seen_;
  std::vector<WeightedWord> corrections;
  for (const auto& [q, c] : activeWords(table_, query)) {
    const LikelihoodTable::WordTerms& terms = table_.word(q);
    at_empty_place += terms.absent[c] - terms.absent[0];
    corrections.push_back({q, (terms.present[c] - terms.absent[c]) - (terms.present[0] - terms.absent[0])});
  }
  result.assign(size(), 0.0);
  postings_.addWeights(corrections, result);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += at_empty_place + empty_query_[i];
}

}  // namespace fabmap_node
