// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "condense/chain_sum.hpp"
#include "condense/chains.hpp"
#include "pose_graph/problem.hpp"

namespace pose_graph {

/// A pose graph with each chain reduced to one edge, and its expansion to all poses. Geodesic objective. Derivation:
/// docs/derivations/pose_graph.md.
///
/// The poses between the ends of a chain are constrained by the chain only. For given ends they minimise the chain's
/// cost, and the minimum as a function of the ends is, to second order, an edge with the chain's composed transform and
/// the sum of its covariances (Newman et al. 2009, eq. 8-13: the composition and its Jacobians; here summed as twists
/// about the begin of the chain, so that a chain takes as many operations as it has links). The approximation holds at
/// the present poses, therefore relinearise() and expand() alternate until convergence: each round is a Gauss-Newton
/// step for the intermediate poses and a full minimisation for the core.
template <int D>
class Condensed {
 public:
  /// `problem` must outlive this object. Edges with a weight other than one are not condensed. `weights` may be empty.
  Condensed(const Problem<D>& problem, const std::vector<double>& weights);

  const Chains& chains() const { return chains_; }

  /// Returns the core as a problem: poses in the order of chains().core; edges of chains().core_edges, followed by one
  /// per chain. `poses`: present poses of the whole problem.
  Problem<D> core(const std::vector<Rigid<D>>& poses) const;
  /// Updates the edges of chains in a problem returned by core().
  void renew(Problem<D>& core) const;

  /// Sets the poses of chains from odometry or from `poses`.
  void layByOdometry();
  void layBy(const std::vector<Rigid<D>>& poses);
  /// Sums the links of each chain at its present poses. Returns the cost of all chains.
  double relinearise();
  /// Moves the poses of each chain to fit its ends, given by core poses.
  void expand(const std::vector<Rigid<D>>& core_poses);
  /// Returns the weighted squared distances between the ends of chains and the core poses they should reach.
  double mismatch(const std::vector<Rigid<D>>& core_poses) const;

  /// Returns all poses of the problem: of the core, the chains, and the attached trees by their edges.
  std::vector<Rigid<D>> assemble(const std::vector<Rigid<D>>& core_poses) const;

 private:
  Rigid<D> measured(const Link& link) const;

  const Problem<D>* problem_;
  Chains chains_;
  std::vector<int> core_of_;                  ///< of each pose: its index in the core, or -1
  std::vector<TangentMatrix<D>> covariance_;  ///< of each link's edge: inverse of its information
  std::vector<Rigid<D>> at_;                  ///< T_begin_pose of each link's end
  std::vector<ChainSum<D>> link_sums_;
  std::vector<ChainSum<D>> chain_sums_;
  std::vector<double> chain_costs_;
};

extern template class Condensed<2>;
extern template class Condensed<3>;

}  // namespace pose_graph
