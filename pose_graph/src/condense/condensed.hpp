// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "condense/chain_sum.hpp"
#include "condense/chains.hpp"
#include "pose_graph/problem.hpp"

namespace pose_graph {

/// A pose graph whose chains are each replaced by one edge, and brought back again. Geodesic objective. Derivation:
/// docs/derivations/pose_graph.md.
///
/// The poses between the ends of a chain see nothing but the chain: for given ends they are where the chain's cost is
/// least, and that cost, as a function of the ends, is to second order an edge with the chain's composed transform and
/// the sum of its covariances (Newman et al. 2009, eq. 8-13: the composition and its Jacobians; here summed as twists
/// about the chain's begin, so that a chain costs as many operations as it has links). The second order is exact at a
/// point only, so relinearise() and expand() alternate until nothing moves: each round is a Gauss-Newton step for the
/// poses in between and a full minimisation for the core.
template <int D>
class Condensed {
 public:
  /// `problem` must outlive it. Edges with a weight other than one stay as they are; `weights` may be empty.
  Condensed(const Problem<D>& problem, const std::vector<double>& weights);

  const Chains& chains() const { return chains_; }

  /// The core as a problem of its own: poses in the order of chains().core; its edges are those of chains().core_edges
  /// and after them one for each chain. `poses` are where the core poses stand now.
  Problem<D> core(const std::vector<Rigid<D>>& poses) const;
  /// The same edges renewed, of the chains alone.
  void renew(Problem<D>& core) const;

  /// Chains lie as odometry measured them, or as these poses have them.
  void layByOdometry();
  void layBy(const std::vector<Rigid<D>>& poses);
  /// Sums each chain's links where it lies now. Returns the cost of all chains there.
  double relinearise();
  /// Moves the poses of each chain to where they fit its ends, given by core poses.
  void expand(const std::vector<Rigid<D>>& core_poses);
  /// What the ends of chains are still away from the poses they end at: the sum of weighted squares.
  double mismatch(const std::vector<Rigid<D>>& core_poses) const;

  /// All poses of the problem: the core's, the chains', and the twigs' by their edges.
  std::vector<Rigid<D>> assemble(const std::vector<Rigid<D>>& core_poses) const;

 private:
  Rigid<D> measured(const Link& link) const;

  const Problem<D>* problem_;
  Chains chains_;
  std::vector<int> core_of_;                  ///< of each pose, its number in the core or -1
  std::vector<TangentMatrix<D>> covariance_;  ///< of each link's edge: the inverse of its information
  std::vector<Rigid<D>> at_;                  ///< T_begin_pose of each link's end
  std::vector<ChainSum<D>> link_sums_;
  std::vector<ChainSum<D>> chain_sums_;
  std::vector<double> chain_costs_;
};

extern template class Condensed<2>;
extern template class Condensed<3>;

}  // namespace pose_graph
