// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pose_graph/problem.hpp"
#include "pose_graph/robust.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace pose_graph::bench {

/// Open: drawn as false but near the right poses, though not to its information. Both keeping and rejecting it are
/// right.
enum class EdgeTruth { True, False, Open };

/// A graph with known errors.
template <int D>
struct WrongGraph {
  Problem<D> problem;
  std::vector<Rigid<D>> right;   ///< right poses
  std::vector<EdgeTruth> truth;  ///< by edge
};

/// One kind of erroneous graph: false closures among true ones, odometry with false closures only, a slipped step of
/// odometry, information of the wrong scale, two sessions with few closures.
template <int D>
struct WrongKind {
  std::string name;
  bool is_drawn = true;  ///< false: there is only one graph of this kind
  std::function<WrongGraph<D>(urban_nav_core::testing::Dice&)> draw;
};

/// Returns all kinds for one graph. `optimum`: its least-squares solution. Both arguments must outlive the result.
template <int D>
std::vector<WrongKind<D>> wrongKinds(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum);

/// Returns the rms distance of `poses` from the right ones after the best rigid motion, m; of parts that no true edge
/// joins, the largest.
template <int D>
double distanceFromRight(const WrongGraph<D>& wrong, const std::vector<Rigid<D>>& poses);

/// Returns whether an edge joins pose i with pose i + 1.
template <int D>
bool isStep(const Edge<D>& edge) {
  return edge.to == edge.from + 1;
}

/// Returns the longest side of the bounding box of all poses, m.
template <int D>
double longestSide(const std::vector<Rigid<D>>& poses);

/// Returns the number of warnings that `relax` gives for this result.
template <int D>
std::size_t countWarnings(const Problem<D>& problem, const RobustSolution<D>& robust);

}  // namespace pose_graph::bench
