// SPDX-License-Identifier: BSD-3-Clause
#include "robust/variance_factor.hpp"

#include <algorithm>

#include "linear/index.hpp"

namespace pose_graph {

namespace {

// Loops of near closures (information_scale.hpp) may hide what only long ways show: twice their deviations are allowed
// for until there are closures to tell. 1 loses more true ones (manhattan: 25 of 1954 for 12), 2 does as well.
constexpr double kCaution = 4.0;
constexpr double kPriorTangents = 10.0;

}  // namespace

template <int D>
double varianceFactor(const ClosureEvaluator<D>& evaluator, const std::vector<char>& in,
                      const std::vector<Rigid<D>>& poses, int unknowns, const Thresholds& thresholds, double scale) {
  const double expected = scale < 1.0 ? std::min(1.0, kCaution * scale) : scale;
  std::vector<std::pair<double, int>> squares;
  double redundancy = -static_cast<double>(unknowns) * kTangentSize<D>;
  for (std::size_t e = 0; e < in.size(); ++e) {
    if (!in[e]) continue;
    const WhitenedEdge<D>& edge = evaluator.edge(static_cast<int>(e));
    squares.emplace_back(whitenedError(edge, poses[sz(edge.from)], poses[sz(edge.to)]).squaredNorm(), edge.rank);
    redundancy += edge.rank;
  }
  if (redundancy <= 0.0) return expected;
  const double prior = kPriorTangents * kTangentSize<D>;
  double factor = expected;
  for (int i = 0; i < 8; ++i) {
    double sum = prior * expected;
    for (const auto& [square, rank] : squares) sum += std::min(square, factor * thresholds.limit[sz(rank)]);
    factor = std::min(sum / (redundancy + prior), std::max(1.0, scale));
  }
  return factor;
}

template double varianceFactor<2>(const ClosureEvaluator<2>&, const std::vector<char>&, const std::vector<Rigid<2>>&,
                                  int, const Thresholds&, double);
template double varianceFactor<3>(const ClosureEvaluator<3>&, const std::vector<char>&, const std::vector<Rigid<3>>&,
                                  int, const Thresholds&, double);

}  // namespace pose_graph
