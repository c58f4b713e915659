// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "problems.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace pose_graph::bench {

/// How false closures are drawn (Suenderhauf and Protzel, Switchable constraints for robust pose graph SLAM, IROS 2012,
/// and the script that is theirs): between any poses or near ones, alone or ten in a row that agree with each other.
struct FalseKind {
  const char* name;
  bool local;
  std::size_t group;
};
constexpr FalseKind kFalseKinds[] = {
    {"random", false, 1}, {"random, in tens", false, 10}, {"local", true, 1}, {"local, in tens", true, 10}};

constexpr double kRightM = 1.0, kRightRad = 0.35;  // a drawn closure nearer than this to the optimum is right by chance

/// Appends `count` false closures with the information of the graph's first closure.
template <int D>
void addFalse(Problem<D>& problem, const FalseKind& kind, std::size_t count, urban_nav_core::testing::Dice& dice);

/// Root mean square of the distances of two sets of positions after the best rigid motion, metres.
template <int D>
double apart(const std::vector<Rigid<D>>& a, const std::vector<Rigid<D>>& b);

/// What became of a graph with false closures added.
struct FalseOutcome {
  double error_m = 0.0;  ///< root mean square from the optimum without them, after the best rigid motion
  double seconds = 0.0;
  std::size_t wrong = 0, kept = 0, closures = 0, lost = 0;
};

/// A graph and its optimum without false closures, by the plain solver.
class CleanGraph {
 public:
  explicit CleanGraph(AnyProblem problem);

  std::size_t closures() const { return closures_; }
  double extent() const { return extent_; }  ///< metres: the longest side of the box about all poses
  double plainSeconds() const { return seconds_; }
  /// `share` times as many false closures as the graph has closures.
  FalseOutcome with(const FalseKind& kind, double share, std::uint64_t seed) const;

 private:
  AnyProblem problem_, optimum_;  // of the latter the poses alone
  std::size_t closures_ = 0;
  double extent_ = 0.0, seconds_ = 0.0;
};

}  // namespace pose_graph::bench
