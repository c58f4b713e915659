// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linear/block_cholesky.hpp"
#include "objective/objective.hpp"

namespace pose_graph {

/// Which poses of a graph are unknown: all but the fixed ones and, of each connected component without any, the first.
/// All fixed poses, and what is connected to one of them, are one component: they lie in one frame.
struct Unknowns {
  std::vector<int> of_pose;    ///< name of the unknown, -1 for a pose that is held
  std::vector<int> pose;       ///< of each unknown
  std::vector<int> component;  ///< of each pose, by their first poses
  std::vector<int> origin;     ///< of each component: the first of its poses that is held
  int components = 0;
};
/// Edges with weight zero count as edges: the pattern does not depend on weights.
template <int D>
Unknowns makeUnknowns(const Problem<D>& problem);

/// The sparse linear system of a pose graph: its shape once, its numbers as often as wanted.
template <int D>
class NormalEquations {
 public:
  static constexpr int kN = kTangentSize<D>;

  /// In the order of elimination of `before` where the same poses are free, no edges are gone, and a factorisation
  /// takes hardly longer than the one that order was found for: finding it anew costs as much as several of them.
  explicit NormalEquations(const Problem<D>& problem, const NormalEquations* before = nullptr);
  NormalEquations(const NormalEquations&) = delete;
  NormalEquations& operator=(const NormalEquations&) = delete;

  const Unknowns& unknowns() const { return unknowns_; }
  const Symbolic& symbolic() const { return symbolic_; }
  const BlockPattern& pattern() const { return pattern_; }
  const std::vector<EdgeTerm<D>>& terms() const { return terms_; }

  /// Takes the measurements of the edges from `first` on anew; what they connect must be the same.
  void renew(const Problem<D>& problem, std::size_t first);

  /// Linearises all edges at these poses; `weights` as in cost(). Returns the cost.
  double linearise(Objective objective, const std::vector<Rigid<D>>& poses, const std::vector<double>& weights);
  double cost(Objective objective, const std::vector<Rigid<D>>& poses, const std::vector<double>& weights) const;

  /// H x = -g by places, after linearise: H, and g.
  const BlockMatrix<kN>& H() const { return H_; }
  BlockMatrix<kN>& H() { return H_; }
  const std::vector<double>& g() const { return g_; }

  /// Where the blocks of an edge lie; places are -1 for poses that are held.
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
  } ordered_;  // the graph that the order was found for
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
