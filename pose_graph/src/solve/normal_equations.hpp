// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linear/block_cholesky.hpp"
#include "objective/objective.hpp"

namespace pose_graph {

/// Unknown poses of a graph: all except the fixed ones and the first pose of each connected component without fixed
/// poses. All fixed poses and the poses connected to them form one component, since they share a frame.
struct Unknowns {
  std::vector<int> of_pose;    ///< index of the unknown; -1 for a held pose
  std::vector<int> pose;       ///< pose of each unknown
  std::vector<int> component;  ///< of each pose, numbered in the order of first poses
  std::vector<int> origin;     ///< of each component: its first held pose
  int components = 0;
};
/// Edges with weight zero count as edges: the pattern is independent of weights.
template <int D>
Unknowns makeUnknowns(const Problem<D>& problem);

/// The sparse linear system of a pose graph, with constant structure and variable values.
template <int D>
class NormalEquations {
 public:
  static constexpr int kN = kTangentSize<D>;

  /// Reuses the elimination order of `before` if the same poses are unknown, no edges were removed, and the
  /// factorisation takes little more work than the one the order was computed for; computing an order takes as long as
  /// several factorisations.
  explicit NormalEquations(const Problem<D>& problem, const NormalEquations* before = nullptr);
  NormalEquations(const NormalEquations&) = delete;
  NormalEquations& operator=(const NormalEquations&) = delete;

  const Unknowns& unknowns() const { return unknowns_; }
  const Symbolic& symbolic() const { return symbolic_; }
  const BlockPattern& pattern() const { return pattern_; }
  const std::vector<EdgeTerm<D>>& terms() const { return terms_; }

  /// Reloads the measurements of edge `first` and all later ones. Requires: edges connect the same poses as before.
  void renew(const Problem<D>& problem, std::size_t first);

  /// Linearises all edges at these poses; `weights` as in cost(). Returns the cost.
  double linearise(Objective objective, const std::vector<Rigid<D>>& poses, const std::vector<double>& weights);
  double cost(Objective objective, const std::vector<Rigid<D>>& poses, const std::vector<double>& weights) const;

  /// H and g of H x = -g, in order of places, after linearise().
  const BlockMatrix<kN>& H() const { return H_; }
  BlockMatrix<kN>& H() { return H_; }
  const std::vector<double>& g() const { return g_; }

  /// Places of an edge's blocks; -1 for held poses.
  struct EdgePlace {
    int from = -1, to = -1;
    BlockPattern::Slot slot;
  };
  const std::vector<EdgePlace>& edgePlaces() const { return places_; }

 private:
  template <Objective objective>
  double lineariseAs(const std::vector<Rigid<D>>& poses, const std::vector<double>& weights);
  template <Objective objective>
  double costAs(const std::vector<Rigid<D>>& poses, const std::vector<double>& weights) const;

  Symbolic analyseAfter(const NormalEquations* before);

  Unknowns unknowns_;
  Adjacency graph_;
  struct {
    std::size_t neighbours = 0;
    double work = 0.0;
  } ordered_;  // size and work of the graph that the order was computed for
  Symbolic symbolic_;
  BlockPattern pattern_;
  std::vector<EdgeTerm<D>> terms_;
  std::vector<EdgePlace> places_;
  BlockMatrix<kN> H_;
  std::vector<double> g_;
};

extern template class NormalEquations<2>;
extern template class NormalEquations<3>;

}  // namespace pose_graph
