// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "solve/minimise.hpp"

namespace pose_graph {

/// Steps from near the minimum to it: on public graphs six at most.
constexpr int kSettleSteps = 10;
/// Steps at most where a share of the cost ends a relaxation.
constexpr int kMostSteps = 20;
/// Share of the cost that changes no decision between two sets of edges: of ten thousand numbers it is one.
constexpr double kEndShare = 1e-4;

/// The part of a graph that is accepted for the moment, and its linear system. Only these edges are in the pattern, and
/// few that were shortly before: false ones between far places would make the factor dense.
template <int D>
class AcceptedGraph {
 public:
  static constexpr int kN = kTangentSize<D>;

  /// `problem` must outlive it. `most_work`: beyond which it is too dense.
  explicit AcceptedGraph(const Problem<D>& problem, double most_work = std::numeric_limits<double>::infinity())
      : problem_(&problem), most_work_(most_work) {}

  /// Takes these edges (those not 0), with weights by edge of the whole problem, or ones if empty.
  void take(const std::vector<char>& in, const std::vector<double>& weights = {});

  /// Takes the measurements of the problem anew; what they connect must be the same.
  void renew();

  /// What it would take to factor these edges, in multiplications of blocks. `soon`: in the order that is found
  /// soonest, where it may be more.
  double work(const std::vector<char>& in, bool soon = false) const;
  /// Whether what is accepted takes more than the most work to factor.
  bool isTooDense() const;

  /// Steps until what is left to gain is less than this share of the cost. `afresh`: from rotations found without a
  /// guess if that costs less than `poses`. Ends too where the cost will stay above `most`: were the next steps to gain
  /// as much as the last one.
  void relax(std::vector<Rigid<D>>& poses, int iterations, double share, bool afresh,
             double most = std::numeric_limits<double>::infinity());

  /// To where nothing worth the name is left to gain. From where these poses are, or, where that is a long way, from no
  /// first guess, if that ends lower.
  void settle(std::vector<Rigid<D>>& poses);

  double cost(const std::vector<Rigid<D>>& poses) const {
    return equations_->cost(Objective::Geodesic, poses, weights_);
  }

  /// Linearises and factors at these poses; directions without information are held by a damping that is nothing
  /// beside the others. False where even that fails.
  bool factor(const std::vector<Rigid<D>>& poses);
  /// Of H, after factor().
  double logDeterminant() const { return cholesky_->logDeterminant(); }
  /// What some of the edges inside (by edge of the whole problem) have of the cost, and of the unknowns: the trace of
  /// their part of H times H^-1. After factor() at these poses.
  struct Share {
    double cost = 0.0, unknowns = 0.0;
  };
  Share share(const std::vector<Rigid<D>>& poses, const std::vector<char>& some);
  /// X becomes H^-1 X after factor(): eight right-hand sides that lie side by side, 8 N numbers a place.
  void solveEight(double* X) const { cholesky_->solveEight(X); }
  int unknowns() const { return static_cast<int>(equations_->unknowns().pose.size()); }
  /// Where a pose's N numbers stand; -1 for one that is held.
  int place(int pose) const;
  /// Poses are comparable if they are of one component.
  int component(int pose) const { return equations_->unknowns().component[static_cast<std::size_t>(pose)]; }

 private:
  // Whether these edges are hardly fewer than those of the pattern, and hold together what they do.
  bool canKeepPattern(const std::vector<char>& in) const;

  const Problem<D>* problem_;
  double most_work_;
  Problem<D> part_;  // of the pattern
  std::vector<char> in_, pattern_;
  std::vector<double> weights_;  // of the edges of the pattern; empty: ones
  std::unique_ptr<NormalEquations<D>> equations_;
  std::unique_ptr<BlockCholesky<kN>> cholesky_;
};

extern template class AcceptedGraph<2>;
extern template class AcceptedGraph<3>;

}  // namespace pose_graph
