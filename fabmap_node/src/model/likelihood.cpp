// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/model/likelihood.hpp"

#include <cmath>

namespace fabmap_node {
namespace {

double toProbability(bool value, double p_true) { return value ? p_true : 1.0 - p_true; }

/// Returns p(z_q = z | z_parent, e) with p(z_q = 1 | e) = `detection`.
double observationGivenElement(const ChowLiuTree& tree, Word q, bool z, bool parent, double detection,
                               Dependence dependence) {
  const double given_element = toProbability(z, detection);
  if (dependence == Dependence::Naive) return given_element;
  const double conditional = toProbability(z, parent ? tree.p_parent_present[q] : tree.p_parent_absent[q]);
  const double marginal = toProbability(z, tree.p[q]);
  const double a = marginal * (1.0 - given_element) * (1.0 - conditional);
  const double b = (1.0 - marginal) * given_element * conditional;
  return b / (a + b);
}

/// Returns p(e_q = 1 | word present or absent at the place), with p(e_q = 1) = p(z_q = 1).
double elementGivenPlace(double p, double likelihood_exists, double likelihood_absent) {
  return likelihood_exists * p / (likelihood_exists * p + likelihood_absent * (1.0 - p));
}

std::vector<char> presence(std::size_t words, const WordSet& set) {
  std::vector<char> present(words, 0);
  for (const Word q : set) present[q] = 1;
  return present;
}

}  // namespace

LikelihoodTable::LikelihoodTable(const ChowLiuTree& tree, const Detector& detector, Dependence dependence)
    : words_(tree.size()), parents_(tree.parent), children_(tree.size()) {
  const double hit = detector.present_given_exists, false_alarm = detector.present_given_absent;
  for (Word q = 0; q < tree.size(); ++q) {
    if (tree.parent[q] == q) root_ = q;
    else children_[tree.parent[q]].push_back(q);
    const double p = tree.p[q];
    const double exists_present = elementGivenPlace(p, hit, false_alarm);
    const double exists_absent = elementGivenPlace(p, 1.0 - hit, 1.0 - false_alarm);
    for (Combination c = 0; c < 4; ++c) {
      const bool z = (c & 2u) != 0, parent = (c & 1u) != 0;
      const double with = observationGivenElement(tree, q, z, parent, hit, dependence);
      const double without = observationGivenElement(tree, q, z, parent, false_alarm, dependence);
      const auto mixed = [&](double exists) { return std::log(exists * with + (1.0 - exists) * without); };
      words_[q].present[c] = mixed(exists_present);
      words_[q].absent[c] = mixed(exists_absent);
      words_[q].unknown[c] = mixed(p);
    }
  }
}

double logLikelihoodPlain(const LikelihoodTable& table, const WordSet& query, const WordSet& place) {
  const std::vector<char> z = presence(table.size(), query), seen = presence(table.size(), place);
  double sum = 0.0;
  for (Word q = 0; q < table.size(); ++q) {
    const auto c = static_cast<LikelihoodTable::Combination>(2 * z[q] + z[table.parents()[q]]);
    sum += seen[q] != 0 ? table.word(q).present[c] : table.word(q).absent[c];
  }
  return sum;
}

double logLikelihoodUnknown(const LikelihoodTable& table, const WordSet& query) {
  const std::vector<char> z = presence(table.size(), query);
  double sum = 0.0;
  for (Word q = 0; q < table.size(); ++q)
    sum += table.word(q).unknown[static_cast<LikelihoodTable::Combination>(2 * z[q] + z[table.parents()[q]])];
  return sum;
}

}  // namespace fabmap_node
