// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/common_error.hpp"

#include "linear/index.hpp"
#include "pose_graph/marginals.hpp"
#include "pose_graph/solution.hpp"
#include "support/drawn.hpp"

namespace pose_graph::test {
namespace {

/// Returns the measurements with an error of `step` standard deviations.
template <int D>
Problem<D> withError(const Problem<D>& problem, const CommonError<D>& error, double step) {
  Problem<D> displaced = problem;
  for (std::size_t e = 0; e < error.of_edge.size(); ++e)
    displaced.edges[e].Z = moved(displaced.edges[e].Z, Tangent<D>(step * error.of_edge[e]));
  return displaced;
}

template <int D>
std::vector<Rigid<D>> solveFromVertices(const Problem<D>& problem) {
  SolveOptions options;
  options.start = Start::Vertices;
  return solve(problem, options).poses;
}

/// Returns the motion of T_a_b, in the axes of a.
template <int D>
Tangent<D> moveBetween(const std::vector<Rigid<D>>& before, const std::vector<Rigid<D>>& after, int a, int b) {
  const Rigid<D> was = before[sz(a)].inverse() * before[sz(b)], is = after[sz(a)].inverse() * after[sz(b)];
  Tangent<D> motion;
  motion << is.t - was.t, logRotation(Rotation<D>(is.R * was.R.transpose()));
  return motion;
}

template <int D>
void expectTheMovedMinimum() {
  Dice dice(21);
  Problem<D> problem = drawProblem<D>(dice, 14, 5, 1e-3, 1e-3);
  CommonError<D> first, second;
  for (std::size_t e = 0; e < problem.edges.size(); ++e) first.of_edge.push_back(drawTangent<D>(dice, 0.1, 0.1));
  for (std::size_t e = 0; e < 6; ++e) second.of_edge.push_back(drawTangent<D>(dice, 0.1, 0.1));
  problem.poses = solveFromVertices(problem);
  const Marginals<D> without(problem, problem.poses), with(problem, problem.poses, {}, {first, second});
  constexpr double kStep = 1e-4;
  const auto plus_first = solveFromVertices(withError(problem, first, kStep)),
             minus_first = solveFromVertices(withError(problem, first, -kStep)),
             plus_second = solveFromVertices(withError(problem, second, kStep)),
             minus_second = solveFromVertices(withError(problem, second, -kStep));
  for (int a = 0; a < 14; a += 3)
    for (int b = 0; b < 14; b += 4) {
      if (a == b) continue;
      const Tangent<D> u = moveBetween<D>(minus_first, plus_first, a, b) / (2.0 * kStep),
                       v = moveBetween<D>(minus_second, plus_second, a, b) / (2.0 * kStep);
      const TangentMatrix<D> expected = u * u.transpose() + v * v.transpose(),
                             added = with.between(a, b).covariance - without.between(a, b).covariance;
      EXPECT_LT((added - expected).norm(), 0.02 * expected.norm()) << a << " " << b;
    }
}
TEST(CommonErrors, AddTheSquareOfHowFarTheMinimumMoves) {
  expectTheMovedMinimum<2>();
  expectTheMovedMinimum<3>();
}

TEST(CommonErrors, AScaleOfAllLengthsScalesTheMap) {
  Dice dice(22);
  Problem<3> problem = drawProblem<3>(dice, 12, 4, 0.0, 0.0);
  CommonError<3> scale;
  for (const Edge<3>& edge : problem.edges) {
    scale.of_edge.push_back(Tangent<3>::Zero());
    scale.of_edge.back().head<3>() = 0.01 * edge.Z.t;
  }
  const Marginals<3> without(problem, problem.poses), with(problem, problem.poses, {}, {scale});
  for (int b = 1; b < 12; ++b) {
    const Eigen::Vector3d path = 0.01 * (problem.poses[0].inverse() * problem.poses[sz(b)]).t;
    TangentMatrix<3> expected = TangentMatrix<3>::Zero();
    expected.topLeftCorner<3, 3>() = path * path.transpose();
    EXPECT_LT((with.ofPose(b).covariance - without.ofPose(b).covariance - expected).norm(), 1e-8 * expected.norm());
  }
}

TEST(CommonErrors, OfRejectedEdgesDoNotCount) {
  Dice dice(23);
  Problem<3> problem = drawProblem<3>(dice, 8, 2, 1e-3, 1e-3);
  std::vector<double> weights(problem.edges.size(), 1.0);
  weights[weights.size() - 2] = 0.0;
  CommonError<3> rejected, accepted;
  rejected.of_edge.assign(problem.edges.size(), Tangent<3>::Zero());
  accepted = rejected;
  rejected.of_edge[weights.size() - 2] = drawTangent<3>(dice, 1.0, 1.0);
  accepted.of_edge[weights.size() - 1] = drawTangent<3>(dice, 1.0, 1.0);
  const Marginals<3> without(problem, problem.poses, weights),
      as_before(problem, problem.poses, weights, {rejected}), with(problem, problem.poses, weights, {accepted});
  double added = 0.0;
  for (int b = 1; b < 8; ++b) {
    EXPECT_EQ(as_before.ofPose(b).covariance, without.ofPose(b).covariance);
    added += (with.ofPose(b).covariance - without.ofPose(b).covariance).norm();
  }
  EXPECT_GT(added, 1e-3);
}

/// Without information on the third coordinate, the others are known as in the problem of the other five.
TEST(CommonErrors, ReduceASingularInformation) {
  Dice dice(24);
  Problem<3> problem;
  problem.poses.assign(3, Rigid<3>());
  CommonError<3> common;
  Tangent<3> known = Tangent<3>::Constant(4.0);
  known[2] = 0.0;
  for (int i = 1; i < 3; ++i) {
    problem.poses[sz(i)].t = Eigen::Vector3d(i, 0.0, 0.0);
    problem.edges.push_back({i - 1, i, problem.poses[sz(i - 1)].inverse() * problem.poses[sz(i)], known.asDiagonal()});
    common.of_edge.push_back(Tangent<3>::Zero());
    common.of_edge.back()[0] = 0.5;
  }
  const Marginal<3> without = Marginals<3>(problem, problem.poses).ofPose(2),
                    with = Marginals<3>(problem, problem.poses, {}, {common}).ofPose(2);
  ASSERT_EQ(with.knowledge, Knowledge::Partial);
  // Two steps with variance 1/4 along x, and twice 0.5 m of a common error.
  EXPECT_NEAR(1.0 / without.information(0, 0), 0.5, 1e-6);
  EXPECT_NEAR(1.0 / with.information(0, 0), 1.5, 1e-6);
  EXPECT_NEAR(with.information(2, 2), 0.0, 1e-9);
  EXPECT_NEAR(with.information(3, 3), without.information(3, 3), 1e-6);
}

}  // namespace
}  // namespace pose_graph::test
