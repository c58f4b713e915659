// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pose_graph/problem.hpp"
#include "pose_graph/robust.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace pose_graph::bench {

/// Open: drawn as false and yet near the right poses, though not to its information. Keeping and rejecting it are both
/// right.
enum class EdgeTruth { True, False, Open };

/// A graph with what is wrong about it.
template <int D>
struct WrongGraph {
  Problem<D> problem;
  std::vector<Rigid<D>> right;   ///< poses
  std::vector<EdgeTruth> truth;  ///< by edge
};

/// One kind of wrong graph: false closures among true ones, odometry and false closures alone, a step of odometry that
/// slipped, information of the wrong scale, two sessions that few closures join.
template <int D>
struct WrongKind {
  std::string name;
  bool is_drawn = true;  ///< otherwise one graph is all there is of it
  std::function<WrongGraph<D>(urban_nav_core::testing::Dice&)> draw;
};

/// All kinds of one graph, of which `optimum` is the least-squares solution. Both must outlive the result.
template <int D>
std::vector<WrongKind<D>> wrongKinds(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum);

/// Metres: how far `poses` lie from the right ones, rms after the best rigid motion; of parts that no true edge joins
/// the worst.
template <int D>
double distanceFromRight(const WrongGraph<D>& wrong, const std::vector<Rigid<D>>& poses);

/// Joins pose i with pose i + 1.
template <int D>
bool isStep(const Edge<D>& edge) {
  return edge.to == edge.from + 1;
}

/// Metres: the longest side of the box about all poses.
template <int D>
double longestSide(const std::vector<Rigid<D>>& poses);

/// How many warnings `relax` gives with this result.
template <int D>
std::size_t countWarnings(const Problem<D>& problem, const RobustSolution<D>& robust);

}  // namespace pose_graph::bench
