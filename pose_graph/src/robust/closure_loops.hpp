// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <utility>
#include <vector>

#include "robust/dead_reckoning.hpp"

namespace pose_graph {

/// Two closures and the odometry between their ends. The way from one pose along odometry to the next, over one
/// closure, along odometry again and back over the other closure ends where it began if both are true (Olson, Walter,
/// Leonard, Teller, Single-cluster graph partitioning for robotics applications, RSS 2005).
struct ClosureLoop {
  double chi2 = 0.0;       ///< of the tangent that remains, with all covariances as stated
  double log_true = 0.0;   ///< logarithm of the density of no remainder at all, were both true
  double log_false = 0.0;  ///< of any remainder, were one of them anywhere
};

/// Closures in the order of their ends, for pairs of near ones.
template <int D>
class ClosureLoops {
 public:
  /// `problem` and `chains` must outlive it.
  ClosureLoops(const Problem<D>& problem, const std::vector<int>& candidates, const DeadReckoning<D>& chains);

  std::size_t size() const { return closures_.size(); }
  int edge(std::size_t i) const { return closures_[i].edge; }
  /// Costs the number of poses between the ends.
  ClosureLoop loop(std::size_t a, std::size_t b) const;

  /// visit(b) for the closures after `a` that are near it, at most `most`: both ends at most kNear poses apart;
  /// between two chains, which nothing else can vouch for, however far apart.
  template <typename Visit>
  void partners(std::size_t a, int most, const Visit& visit) const {
    const auto on = closureChains(closures_[a]);
    const bool between = on.first != on.second;
    for (std::size_t b = a + 1; b < closures_.size() && most > 0; ++b) {
      if (closureChains(closures_[b]) != on || (!between && closures_[b].from > closures_[a].from + kNear)) return;
      if (!between && std::abs(closures_[b].to - closures_[a].to) > kNear) continue;
      --most;
      visit(b);
    }
  }

 private:
  /// Poses: about the length of a visit to a place; beyond, odometry's own error hides what a pair says.
  static constexpr int kNear = 10;

  struct Closure {  // its ends in the order of their numbers
    int edge = 0, from = 0, to = 0;
    Rigid<D> Z;
    TangentMatrix<D> covariance;  // in the frame of `from`
  };
  static Closure toClosure(const Problem<D>& problem, int edge, double extent);
  std::pair<int, int> closureChains(const Closure& c) const {
    return {chains_->of_pose[static_cast<std::size_t>(c.from)], chains_->of_pose[static_cast<std::size_t>(c.to)]};
  }

  const DeadReckoning<D>* chains_;
  std::vector<Closure> closures_;
};

extern template class ClosureLoops<2>;
extern template class ClosureLoops<3>;

}  // namespace pose_graph
