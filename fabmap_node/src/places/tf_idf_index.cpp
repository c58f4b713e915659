// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/places/tf_idf_index.hpp"

#include <cmath>

namespace fabmap_node {

TfIdfIndex::TfIdfIndex(const ChowLiuTree& tree) : postings_(tree.size()) {
  for (const double p : tree.p) weights_.push_back(-std::log(p));
}

double TfIdfIndex::norm(const WordSet& words) const {
  double sum = 0.0;
  for (const Word q : words) sum += weights_[q] * weights_[q];
  return std::sqrt(sum);
}

void TfIdfIndex::add(const WordSet& place) {
  postings_.add(place);
  norms_.push_back(norm(place));
}

void TfIdfIndex::similarities(const WordSet& query, std::vector<double>& result) const {
  std::vector<WeightedWord> squares;
  for (const Word q : query) squares.push_back({q, weights_[q] * weights_[q]});
  result.assign(size(), 0.0);
  postings_.addWeights(squares, result);
  const double own = norm(query);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double scale = own * norms_[i];
    result[i] = scale > 0.0 ? result[i] / scale : 0.0;
  }
}

}  // namespace fabmap_node
