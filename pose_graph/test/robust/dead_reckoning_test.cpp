// SPDX-License-Identifier: BSD-3-Clause
#include "robust/evidence/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include "pose_graph/solution.hpp"
#include "support/held_graph.hpp"

namespace pose_graph::test {
namespace {

template <int D>
void expectNeitherScaledNorRejected(Held held) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Dice dice(seed);
    const int count = held == Held::Nothing ? 0 : 1 + static_cast<int>(dice.below(3));
    const Problem<D> problem = drawHeld<D>(dice, held, count);
    std::vector<EdgeRole> roles = rolesByNumbers(problem);
    for (std::size_t e = 0; held == Held::ByPriors && e < roles.size(); ++e)
      if (problem.edges[e].from == problem.fixed[0]) roles[e] = EdgeRole::Asserted;
    const RobustSolution<D> robust = relaxSelected(problem, roles, {});
    const bool takes_all = std::all_of(robust.edges.begin(), robust.edges.end(),
                                       [](const EdgeAssessment& edge) { return edge.weight > 0.0; });
    EXPECT_TRUE(takes_all || held == Held::WhereOdometryDrifted) << seed;
    if (takes_all) {
      EXPECT_LE(robust.solution.cost, 1.01 * solve(problem, {}).cost) << seed;
    }
    for (const int pose : problem.fixed)
      EXPECT_EQ(
          (robust.solution.poses[static_cast<std::size_t>(pose)].t - problem.poses[static_cast<std::size_t>(pose)].t)
              .norm(),
          0.0)
          << seed;
  }
}

TEST(CopiedPoses, ThoseWhereOdometryLeadsAreLeftOut) {
  Dice dice(5);
  Problem<3> problem = drawHeld<3>(dice, Held::Nothing, 0);
  const std::vector<EdgeRole> roles = rolesByNumbers(problem);
  problem.fixed = {0, 1, 4, 9};
  EXPECT_EQ(withoutCopiedPoses(problem, roles), std::vector<int>({0})) << "all are dead reckoning";
  problem.poses[4].t[1] += 0.1;  // surveyed
  EXPECT_EQ(withoutCopiedPoses(problem, roles), std::vector<int>({0, 4, 9})) << "9 is not where 4 leads to";
  problem.fixed = {};
  EXPECT_TRUE(withoutCopiedPoses(problem, roles).empty());
}

// A handful of closures does not determine variances better than the stated information.
TEST(CopiedPoses, SmallGraphsAreRelaxedWithTheInformationStated) {
  for (const Held held : kHeld) {
    expectNeitherScaledNorRejected<2>(held);
    expectNeitherScaledNorRejected<3>(held);
  }
}

}  // namespace
}  // namespace pose_graph::test
