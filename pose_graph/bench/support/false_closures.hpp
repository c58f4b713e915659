// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "problems.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace pose_graph::bench {

/// Kinds of false closures (Suenderhauf and Protzel, Switchable constraints for robust pose graph SLAM, IROS 2012, and
/// their script): between any poses or near ones, single or ten consistent ones in a row.
struct FalseKind {
  const char* name;
  bool local;
  std::size_t group;
};
constexpr FalseKind kFalseKinds[] = {
    {"random", false, 1}, {"random, in tens", false, 10}, {"local", true, 1}, {"local, in tens", true, 10}};

// A drawn closure nearer to the optimum than this is accidentally right.
constexpr double kRightM = 1.0, kRightRad = 0.35;

/// Appends `count` false closures with the information of the graph's first closure.
template <int D>
void addFalse(Problem<D>& problem, const FalseKind& kind, std::size_t count, urban_nav_core::testing::Dice& dice);

/// Returns the root mean square distance of two sets of positions after the best rigid motion, m.
template <int D>
double apart(const std::vector<Rigid<D>>& a, const std::vector<Rigid<D>>& b);

/// Result for a graph with false closures added.
struct FalseOutcome {
  double error_m = 0.0;  ///< m: root mean square distance from the optimum without them, after the best rigid motion
  double seconds = 0.0;
  std::size_t wrong = 0, kept = 0, closures = 0, lost = 0;
};

/// A graph and its optimum without false closures, by the plain solver.
class CleanGraph {
 public:
  explicit CleanGraph(AnyProblem problem);

  std::size_t closures() const { return closures_; }
  double extent() const { return extent_; }  ///< m: longest side of the bounding box of all poses
  double plainSeconds() const { return seconds_; }
  /// Returns the outcome with `share` times as many false closures as the graph has closures.
  FalseOutcome with(const FalseKind& kind, double share, std::uint64_t seed) const;

 private:
  AnyProblem problem_, optimum_;  // only the poses of optimum_ are used
  std::size_t closures_ = 0;
  double extent_ = 0.0, seconds_ = 0.0;
};

}  // namespace pose_graph::bench
