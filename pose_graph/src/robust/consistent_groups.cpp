// SPDX-License-Identifier: BSD-3-Clause
#include "robust/consistent_groups.hpp"

#include <algorithm>
#include <cmath>

#include "linear/disjoint_sets.hpp"
#include "linear/index.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace pose_graph {

namespace {

constexpr int kPartners = 20;  // compared with each closure at most: one that agrees is enough

template <int D>
bool agree(const ClosureLoop& loop, double variance, const Thresholds& thresholds) {
  constexpr int kN = kTangentSize<D>;
  if (!(loop.chi2 <= variance * thresholds.limit[kN])) return false;
  const double log_true = loop.log_true - 0.5 * kN * std::log(variance) - 0.5 * loop.chi2 / variance;
  return log_true - loop.log_false >= Thresholds::kEvidence;
}

}  // namespace

Thresholds::Thresholds(std::size_t candidates, int largest_dof) {
  // With few candidates the tests stay as strict as with ten.
  const double each = kFalseAlarms / static_cast<double>(std::max<std::size_t>(10, candidates));
  early_evidence = std::max(kEvidence, -std::log(each));
  limit.assign(1, 0.0);
  for (int dof = 1; dof <= largest_dof; ++dof) limit.push_back(urban_nav_core::chiSquareQuantile(1.0 - each, dof));
}

template <int D>
std::vector<int> consistentGroups(std::size_t edges, const ClosureLoops<D>& closures, double variance,
                                  const Thresholds& thresholds) {
  DisjointSets joined(edges);
  for (std::size_t a = 0; a < closures.size(); ++a)
    closures.partners(a, kPartners, [&](std::size_t b) {
      if (!joined.areJoined(closures.edge(a), closures.edge(b)) && agree<D>(closures.loop(a, b), variance, thresholds))
        joined.join(closures.edge(a), closures.edge(b));
    });
  std::vector<int> group(edges, -1);
  for (std::size_t a = 0; a < closures.size(); ++a) group[sz(closures.edge(a))] = joined.root(closures.edge(a));
  return group;
}

template std::vector<int> consistentGroups<2>(std::size_t, const ClosureLoops<2>&, double, const Thresholds&);
template std::vector<int> consistentGroups<3>(std::size_t, const ClosureLoops<3>&, double, const Thresholds&);

}  // namespace pose_graph
