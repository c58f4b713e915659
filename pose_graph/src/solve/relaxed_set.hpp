// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "condense/core_graph.hpp"
#include "solve/accepted_graph.hpp"

namespace pose_graph {

/// A set of edges of one graph, relaxed with variance factors, and its probability density. If chains of odometry
/// reduce to a small core graph, the set is relaxed and evaluated there: integrating out the poses of a chain leaves
/// the density unchanged. A set with only slightly fewer edges than the previous one reuses its symbolic analysis.
template <int D>
class RelaxedSet {
 public:
  static constexpr int kN = kTangentSize<D>;

  /// Both arguments must outlive this object.
  RelaxedSet(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

  /// Relaxes the edges with nonzero `in` from `poses`, which are set to the minimum. `candidates`, `others`: variance
  /// factors of candidates and of all other edges.
  void relax(const std::vector<char>& in, double candidates, double others, std::vector<Rigid<D>>& poses);
  /// Factors at the result of relax(). Returns false if that fails.
  bool factor() { return graph().factor(poses_); }

  /// Rank of an edge of the whole graph, and log pseudo-determinant of its information.
  int rank(std::size_t e) const { return rank_[e]; }
  double logInformation(std::size_t e) const { return log_information_[e]; }
  /// Number of unknown poses of the whole graph.
  int unknowns() const;

  /// After factor(): the cost, and the candidates' share of the cost and of the unknowns.
  double cost() const { return graph().cost(poses_); }
  typename AcceptedGraph<D>::Share candidates();

  /// Returns the log density of the measurements inside, with the free poses integrated out about the minimum
  /// (Laplace's approximation) and a uniform prior of unit density on each. Requires: factor().
  double logDensity() const;

  /// An accepted candidate predicted by all other measurements, linearised at the minimum.
  struct Prediction {
    /// Density of its measurement; minus infinity if the others do not connect its ends.
    double log_density = -std::numeric_limits<double>::infinity();
    double chi2 = 0.0;  ///< of its innovation, with rank() degrees of freedom; 0 if the others do not connect its ends
  };
  /// Requires: factor().
  Prediction predictByOthers(int candidate) const;

 private:
  const Problem<D>& problem() const { return in_core_ ? core_->problem() : *problem_; }
  const std::vector<EdgeRole>& roles() const { return in_core_ ? core_->roles() : *roles_; }
  AcceptedGraph<D>& graph() const { return in_core_ ? *core_graph_ : *whole_graph_; }
  double varianceFactor(std::size_t e) const { return roles()[e] == EdgeRole::Candidate ? of_candidates_ : of_others_; }
  std::vector<double> weights() const;
  void relaxCore(std::vector<Rigid<D>>& poses);

  const Problem<D>* problem_;
  const std::vector<EdgeRole>* roles_;
  std::vector<int> rank_;
  std::vector<double> log_information_;
  std::optional<CoreGraph<D>> core_;
  std::vector<int> core_edge_;  // -1 for an edge of a chain
  std::unique_ptr<AcceptedGraph<D>> whole_graph_, core_graph_;
  bool in_core_ = false;
  std::vector<char> in_;                          // by edge of problem()
  std::vector<Rigid<D>> poses_;                   // by pose of problem()
  double of_candidates_ = 1.0, of_others_ = 1.0;  // variance factors
};

extern template class RelaxedSet<2>;
extern template class RelaxedSet<3>;

}  // namespace pose_graph
