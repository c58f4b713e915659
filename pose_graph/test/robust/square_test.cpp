// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/robust.hpp"
#include "support/drawn.hpp"

namespace pose_graph {
namespace {

constexpr int kSteps = 80, kSide = 10;  // two laps of a square with steps of 1 m
constexpr double kClosureM = 0.05, kClosureRad = 0.01;

struct Square {
  Problem<2> problem;
  std::size_t first_closure = 0, first_false = 0;
};

void addMeasured(Problem<2>& problem, int from, int to, const Rigid<2>& exact, double metres, double radians,
                 test::Dice& dice) {
  TangentMatrix<2> information = TangentMatrix<2>::Zero();
  information.diagonal() << 1.0 / (metres * metres), 1.0 / (metres * metres), 1.0 / (radians * radians);
  problem.edges.push_back({from, to, moved(exact, test::drawTangent<2>(dice, metres, radians)), information});
}

/// Odometry with these deviations, closures between poses one lap apart, and false closures between places at least 2 m
/// apart.
Square drawSquare(std::uint64_t seed, double metres, double radians, int false_closures) {
  test::Dice dice(seed);
  std::vector<Rigid<2>> truth(1);
  for (int k = 0; k < kSteps; ++k) {
    Tangent<2> step(1.0, 0.0, k % kSide == kSide - 1 ? M_PI / 2.0 : 0.0);
    truth.push_back(truth.back() * moved(Rigid<2>(), step));
  }
  const auto between = [&](int from, int to) {
    return truth[static_cast<std::size_t>(from)].inverse() * truth[static_cast<std::size_t>(to)];
  };
  Square drawn;
  for (int k = 0; k < kSteps; ++k) addMeasured(drawn.problem, k, k + 1, between(k, k + 1), metres, radians, dice);
  drawn.problem.poses.resize(1);
  for (int k = 0; k < kSteps; ++k)
    drawn.problem.poses.push_back(drawn.problem.poses.back() * drawn.problem.edges[static_cast<std::size_t>(k)].Z);
  drawn.first_closure = drawn.problem.edges.size();
  const int lap = 4 * kSide, closures = 10 + static_cast<int>(dice.below(31));
  for (int c = 0; c < closures; ++c) {
    const int from = static_cast<int>(dice.below(static_cast<std::size_t>(kSteps - lap + 1)));
    addMeasured(drawn.problem, from, from + lap, between(from, from + lap), kClosureM, kClosureRad, dice);
  }
  drawn.first_false = drawn.problem.edges.size();
  for (int c = 0; c < false_closures;) {
    const int from = static_cast<int>(dice.below(kSteps + 1)), to = static_cast<int>(dice.below(kSteps + 1));
    const Rigid<2> asserted = test::drawRigid<2>(dice, 0.3, 0.17);
    if (to < from + 5 || (between(from, to).t - asserted.t).norm() < 2.0) continue;
    addMeasured(drawn.problem, from, to, asserted, kClosureM, kClosureRad, dice);
    ++c;
  }
  return drawn;
}

// The true closures are one row along a lap, longer than the square is wide, hence more than one pair of similar
// places, which would be no more than chance.
TEST(Square, FewFalseClosuresCostNoTrueOne) {
  for (const auto& [metres, radians] : {std::pair(0.02, 0.005), std::pair(0.05, 0.01), std::pair(0.1, 0.03)}) {
    for (std::uint64_t seed = 1; seed <= 9; ++seed) {
      const int false_closures = 1 + static_cast<int>(seed % 3);
      const Square square = drawSquare(seed, metres, radians, false_closures);
      const RobustSolution<2> robust = relaxSelected(square.problem, rolesByNumbers(square.problem), {});
      std::size_t lost = 0, kept = 0;
      for (std::size_t e = square.first_closure; e < square.problem.edges.size(); ++e) {
        const bool is_in = robust.edges[e].weight > 0.0;
        lost += e < square.first_false && !is_in;
        kept += e >= square.first_false && is_in;
      }
      EXPECT_EQ(lost, 0u) << "of " << square.first_false - square.first_closure << ", odometry " << metres << ", seed "
                          << seed;
      EXPECT_EQ(kept, 0u) << "of " << false_closures << ", odometry " << metres << ", seed " << seed;
      EXPECT_FALSE(robust.selection.undecided) << metres << ", seed " << seed;
    }
  }
}

}  // namespace
}  // namespace pose_graph
