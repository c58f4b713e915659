// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "robust/closure_loops.hpp"

namespace pose_graph {

/// What tells a true closure's residual from a false one's, in numbers.
struct Thresholds {
  /// The chance that any true closure of the whole graph fails its test (Bonferroni: shared by all).
  static constexpr double kFalseAlarms = 0.05;
  /// Logarithm of how much likelier than chance a closure must be: of false ones that fall where a true one could be,
  /// one in 500 would pass.
  static constexpr double kEvidence = 6.214608098422191;

  std::vector<double> limit;  ///< of chi-square, by degrees of freedom
  /// The same while the graph is still vague: of all candidates together, were all false, one would pass with the
  /// chance kFalseAlarms. What enters then shapes all that follows.
  double early_evidence = 0.0;

  Thresholds(std::size_t candidates, int largest_dof);
};

/// Groups of closures that support each other: near ones whose loop closes, with evidence as in Thresholds (Latif,
/// Cadena, Neira, RRR, RSS 2012). `variance`: factor of all covariances.
///
/// Returns for each of so many edges the number of its group (the first edge of the group), -1 for edges that are no
/// candidates.
template <int D>
std::vector<int> consistentGroups(std::size_t edges, const ClosureLoops<D>& closures, double variance,
                                  const Thresholds& thresholds);

}  // namespace pose_graph
