// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "condense/condensed.hpp"
#include "pose_graph/robust.hpp"

namespace pose_graph {

/// A graph with each trusted chain reduced to one edge of composed transform and covariance. Closures are evaluated in
/// the core graph only, which is small if a robot drives far and seldom revisits places.
template <int D>
class CoreGraph {
 public:
  /// Returns nullopt if too few poses are on chains, or if a closure ends at a pose without other edges. `problem` must
  /// outlive the result.
  static std::optional<CoreGraph> of(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

  const Problem<D>& problem() const { return core_; }
  const std::vector<EdgeRole>& roles() const { return roles_; }
  /// Returns the pose of the whole graph for a core pose.
  int pose(int core_pose) const { return condensed_.chains().core[static_cast<std::size_t>(core_pose)]; }
  /// Returns the edge of the whole graph for a core edge; -1 for an edge that represents a chain.
  int edge(int core_edge) const;
  /// Returns all poses of the graph, with chains fitted to these core poses.
  std::vector<Rigid<D>> expanded(const std::vector<Rigid<D>>& core_poses);
  /// Sets the poses of chains from poses of the whole graph.
  void placeChains(const std::vector<Rigid<D>>& poses) { condensed_.layBy(poses); }
  /// Returns the weighted squared distance between the ends of chains and the core poses they should reach.
  double mismatch(const std::vector<Rigid<D>>& core_poses) const { return condensed_.mismatch(core_poses); }
  /// Updates the chains' edges at the poses set by expanded() or placeChains().
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
