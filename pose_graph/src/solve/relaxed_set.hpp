// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "condense/core_graph.hpp"
#include "solve/accepted_graph.hpp"

namespace pose_graph {

/// A set of edges of one graph, relaxed with factors of their variances, and its density. Where the chains of odometry
/// leave a small core, all of that is done in the core: integrating the poses of a chain out leaves the density what it
/// is. A set that has hardly fewer edges than the one before shares its symbolic analysis.
template <int D>
class RelaxedSet {
 public:
  static constexpr int kN = kTangentSize<D>;

  /// Both must outlive it.
  RelaxedSet(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

  /// Relaxes the edges that are in (by edge) from `poses`, which become those of the minimum, with these factors of the
  /// variances of candidates and of all others.
  void relax(const std::vector<char>& in, double candidates, double others, std::vector<Rigid<D>>& poses);
  /// Factors where relax() led. False where that fails.
  bool factor() { return graph().factor(poses_); }

  /// Directions that an edge of the whole graph measures, and the logarithm of the determinant of its information.
  int rank(std::size_t e) const { return rank_[e]; }
  double logInformation(std::size_t e) const { return log_information_[e]; }
  /// Free poses of the whole graph.
  int unknowns() const;

  /// After factor(): the cost, and what candidates have of it and of the unknowns.
  double cost() const { return graph().cost(poses_); }
  typename AcceptedGraph<D>::Share candidates();

  /// Logarithm of the density of the measurements inside, the free poses integrated out about the minimum (Laplace's
  /// approximation), each a priori anywhere with unit density. After factor().
  double logDensity() const;

  /// Logarithm of the density of a candidate inside given all others, linearised at the minimum; minus infinity where
  /// no others hold its ends together. After factor().
  double logDensityGivenOthers(int candidate) const;

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
  std::vector<int> core_edge_;  // -1 for one of a chain
  std::unique_ptr<AcceptedGraph<D>> whole_graph_, core_graph_;
  bool in_core_ = false;
  std::vector<char> in_;                          // edges of problem()
  std::vector<Rigid<D>> poses_;                   // those of problem()
  double of_candidates_ = 1.0, of_others_ = 1.0;  // factors
};

extern template class RelaxedSet<2>;
extern template class RelaxedSet<3>;

}  // namespace pose_graph
