// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "solve/minimise.hpp"

namespace pose_graph {

/// Limit of steps from near the minimum; public graphs take at most six.
constexpr int kSettleSteps = 10;
/// Limit of steps if a share of the cost ends a relaxation.
constexpr int kMostSteps = 20;
/// Share of the cost that is too small to change a decision between two sets of edges: 1 for ten thousand residuals.
constexpr double kEndShare = 1e-4;

/// The currently accepted part of a graph and its linear system. The sparsity pattern contains only these edges and a
/// few that were accepted shortly before: false edges between distant places would make the factor dense.
template <int D>
class AcceptedGraph {
 public:
  static constexpr int kN = kTangentSize<D>;

  /// `problem` must outlive this object. `most_work`: limit for isTooDense().
  explicit AcceptedGraph(const Problem<D>& problem, double most_work = std::numeric_limits<double>::infinity())
      : problem_(&problem), most_work_(most_work) {}

  /// Selects the edges with nonzero `in`. `weights`: by edge of the whole problem; empty: all 1.
  void take(const std::vector<char>& in, const std::vector<double>& weights = {});

  /// Reloads the measurements of the problem. Requires: edges connect the same poses as before.
  void renew();

  /// Returns the work to factor these edges, in multiplications of blocks. `soon`: with the ordering that is fastest to
  /// compute, which may need more work.
  double work(const std::vector<char>& in, bool soon = false) const;
  /// Returns whether factoring the accepted edges takes more than the limit.
  bool isTooDense() const;

  /// Relaxes until the expected further decrease is below `share` of the cost. `afresh`: starts from chordal relaxation
  /// if its cost is lower than that of `poses`. Stops early if the cost would stay above `most` even if the next step
  /// gained as much as the last one.
  void relax(std::vector<Rigid<D>>& poses, int iterations, double share, bool afresh,
             double most = std::numeric_limits<double>::infinity());

  /// Relaxes to convergence. If that takes too many steps from `poses`, also starts from chordal relaxation and keeps
  /// the better result.
  void settle(std::vector<Rigid<D>>& poses);

  double cost(const std::vector<Rigid<D>>& poses) const {
    return equations_->cost(Objective::Geodesic, poses, weights_);
  }

  /// Linearises and factors at these poses. Directions without information get a damping that is negligible relative to
  /// the others. Returns false if that fails too.
  bool factor(const std::vector<Rigid<D>>& poses);
  /// Log determinant of H after factor().
  double logDeterminant() const { return cholesky_->logDeterminant(); }
  /// Share of some of the accepted edges (by edge of the whole problem) in the cost and in the unknowns: the trace of
  /// their part of H times H^-1. Requires: factor() at these poses.
  struct Share {
    double cost = 0.0, unknowns = 0.0;
  };
  Share share(const std::vector<Rigid<D>>& poses, const std::vector<char>& some);
  /// Replaces X by H^-1 X after factor(). X holds eight right-hand sides side by side, 8 N numbers per place.
  void solveEight(double* X) const { cholesky_->solveEight(X); }
  int unknowns() const { return static_cast<int>(equations_->unknowns().pose.size()); }
  /// Returns the place of a pose in the linear system; -1 for a held pose.
  int place(int pose) const;
  /// Returns the connected component of a pose. Only poses of one component have a relative pose.
  int component(int pose) const { return equations_->unknowns().component[static_cast<std::size_t>(pose)]; }

 private:
  // Returns whether the edges are only slightly fewer than those of the pattern and leave the same connected
  // components.
  bool canKeepPattern(const std::vector<char>& in) const;

  const Problem<D>* problem_;
  double most_work_;
  Problem<D> part_;  // edges of the pattern
  std::vector<char> in_, pattern_;
  std::vector<double> weights_;  // of the edges of the pattern; empty: all 1
  std::unique_ptr<NormalEquations<D>> equations_;
  std::unique_ptr<BlockCholesky<kN>> cholesky_;
};

extern template class AcceptedGraph<2>;
extern template class AcceptedGraph<3>;

}  // namespace pose_graph
