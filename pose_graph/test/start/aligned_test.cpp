// SPDX-License-Identifier: BSD-3-Clause
#include "start/aligned.hpp"

#include "pose_graph/solution.hpp"
#include "support/drawn.hpp"

namespace pose_graph::test {
namespace {

/// A path whose positions are measured from a fixed pose, as by satellites; its initial poses are displaced and
/// rotated.
template <int D>
Problem<D> drawMeasured(Dice& dice, bool with_rotation) {
  Problem<D> result = drawProblem<D>(dice, 20, 4, 0.0, 0.0);
  const int frame = static_cast<int>(result.poses.size());
  for (int pose = 0; pose < frame; pose += 3) {
    Edge<D> prior{frame, pose, result.poses[static_cast<std::size_t>(pose)], {}};
    prior.information = TangentMatrix<D>::Identity();
    if (!with_rotation) {
      prior.Z.R.setIdentity();
      prior.information.template bottomRightCorner<kTangentSize<D> - D, kTangentSize<D> - D>().setZero();
      prior.lever = drawTangent<D>(dice, 0.3, 0.0).template head<D>();
      prior.Z.t += result.poses[static_cast<std::size_t>(pose)].R * prior.lever;
    }
    result.edges.push_back(prior);
  }
  result.poses.emplace_back();
  result.fixed = {frame};
  return result;
}

template <int D>
void expectAligned() {
  Dice dice(3);
  for (int draw = 0; draw < 5; ++draw) {
    const Problem<D> exact = drawMeasured<D>(dice, false);
    EXPECT_FALSE(areRotationsTied(exact, {}));
    EXPECT_TRUE(areRotationsTied(drawMeasured<D>(dice, true), {}));
    Problem<D> elsewhere = exact;
    const Rigid<D> away = drawRigid<D>(dice, 100.0, 2.0);
    for (std::size_t i = 0; i + 1 < elsewhere.poses.size(); ++i) elsewhere.poses[i] = away * elsewhere.poses[i];
    std::vector<Rigid<D>> aligned = elsewhere.poses;
    alignWithFixed(elsewhere, {}, aligned);
    EXPECT_LT(largestDifference(aligned, exact.poses), 1e-9);
    const Solution<D> solution = solve(elsewhere, {});
    EXPECT_LT(solution.cost, 1e-12);
    EXPECT_LT(largestDifference(solution.poses, exact.poses), 1e-6);
  }
}

TEST(Aligned, PositionsAloneTurnAPath) {
  expectAligned<2>();
  expectAligned<3>();
}

TEST(Aligned, WhatMeasuresRotationsIsLeftAlone) {
  Dice dice(4);
  const Problem<3> problem = drawMeasured<3>(dice, true);
  std::vector<Rigid<3>> poses = problem.poses;
  for (Rigid<3>& pose : poses) pose = drawRigid<3>(dice, 5.0, 1.0);
  const std::vector<Rigid<3>> before = poses;
  alignWithFixed(problem, {}, poses);
  EXPECT_EQ(largestDifference(poses, before), 0.0);
}

}  // namespace
}  // namespace pose_graph::test
