// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "condense/condensed.hpp"
#include "pose_graph/robust.hpp"

namespace pose_graph {

/// A graph whose trusted chains are each one edge, with composed transform and covariance as odometry lays them: what
/// to think of its closures can be asked of the core alone, which is small where a robot drives far and comes back
/// seldom.
template <int D>
class CoreGraph {
 public:
  /// Empty where too few poses lie on chains for that to pay, or where a closure ends where nothing else does.
  /// `problem` must outlive it.
  static std::optional<CoreGraph> of(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

  const Problem<D>& problem() const { return core_; }
  const std::vector<EdgeRole>& roles() const { return roles_; }
  /// The pose of the whole graph that one of the core is.
  int pose(int core_pose) const { return condensed_.chains().core[static_cast<std::size_t>(core_pose)]; }
  /// The same of an edge; -1 for one that stands for a chain.
  int edge(int core_edge) const;
  /// All poses of the graph, chains laid to fit these of the core.
  std::vector<Rigid<D>> expanded(const std::vector<Rigid<D>>& core_poses);
  /// Chains lie as these poses of the whole graph have them.
  void placeChains(const std::vector<Rigid<D>>& poses) { condensed_.layBy(poses); }
  /// Distance, in weighted squares, of the ends of chains from the poses they end at.
  double mismatch(const std::vector<Rigid<D>>& core_poses) const { return condensed_.mismatch(core_poses); }
  /// The chains' edges as they are where expanded() or placeChains() put them last.
  void relinearise();

 private:
  explicit CoreGraph(Condensed<D> condensed) : condensed_(std::move(condensed)) {}

  Condensed<D> condensed_;
  Problem<D> core_;
  std::vector<EdgeRole> roles_;
};

extern template class CoreGraph<2>;
extern template class CoreGraph<3>;

}  // namespace pose_graph
