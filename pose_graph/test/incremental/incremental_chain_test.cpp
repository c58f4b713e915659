// SPDX-License-Identifier: BSD-3-Clause
#include "incremental/incremental_chain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "manifold/rotation.hpp"
#include "pose_graph/solution.hpp"

namespace pose_graph {
namespace {

std::vector<ChainStep> arc(int links) {
  std::vector<ChainStep> steps;
  for (int i = 0; i < links; ++i) {
    ChainStep step;
    step.edge.Z = {expRotation(RotationVector<3>(0.01, -0.02, 0.03 + 0.001 * i)), Eigen::Vector3d(0.5, 0.02 * i, 0.1)};
    Tangent<3> weight;
    weight << 1e4, 2e4 + 10.0 * i, 3e4, 1e5, 2e5, 4e5;
    step.edge.information = weight.asDiagonal();
    step.edge.information(0, 4) = step.edge.information(4, 0) = 1e4;
    step.invertible = invert<3>(step.edge.information, step.covariance);
    steps.push_back(step);
  }
  return steps;
}

std::vector<Rigid<3>> laidBy(const std::vector<ChainStep>& steps) {
  std::vector<Rigid<3>> at;
  Rigid<3> T;
  for (const ChainStep& step : steps) at.push_back(T = T * step.edge.Z);
  return at;
}

// Returns the minimum cost over the poses in between, with both ends fixed.
double leastCost(const std::vector<ChainStep>& steps, const Rigid<3>& end) {
  Problem<3> problem;
  problem.poses.emplace_back();
  for (const Rigid<3>& T : laidBy(steps)) problem.poses.push_back(T);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    problem.edges.push_back(steps[i].edge);
    problem.edges.back().from = static_cast<int>(i);
    problem.edges.back().to = static_cast<int>(i) + 1;
  }
  Edge<3> hold{0, static_cast<int>(steps.size()), end, 1e14 * TangentMatrix<3>::Identity()};
  problem.edges.push_back(hold);
  SolveOptions options;
  options.start = Start::Vertices;
  return solve(problem, options, std::vector<double>(problem.edges.size(), 1.0 + 1e-15)).cost;
}

TEST(IncrementalChain, IsOneEdgeThatCostsWhatItsLinksDo) {
  const std::vector<ChainStep> steps = arc(40);
  IncrementalChain chain(steps.data(), laidBy(steps));
  EXPECT_NEAR(chain.bend(laidBy(steps).back()), 0.0, 1e-12);
  const Rigid<3> wanted =
      moved<3>(laidBy(steps).back(), (Tangent<3>() << 0.1, -0.2, 0.05, 0.01, -0.02, 0.03).finished());
  for (int round = 0; round < 4; ++round) chain.lay(wanted, steps.data());
  EXPECT_LT(chain.bend(wanted), 1e-12);
  Problem<3> one;
  one.poses = {Rigid<3>(), wanted};
  one.edges = {chain.edge()};
  one.edges[0].to = 1;
  const double expected = leastCost(steps, wanted);
  EXPECT_GT(expected, 1.0);
  EXPECT_NEAR(cost(one, one.poses, Objective::Geodesic), expected, 1e-4 * expected);
}

TEST(IncrementalChain, SplitsAtItsEnds) {
  const std::vector<ChainStep> steps = arc(20);
  IncrementalChain chain(steps.data(), laidBy(steps));
  const Rigid<3> wanted = moved<3>(laidBy(steps).back(), Tangent<3>::Constant(0.02));
  for (int round = 0; round < 4; ++round) chain.lay(wanted, steps.data());
  IncrementalChain whole = chain;
  const IncrementalChain rest = chain.splitAfter(7, steps.data());
  ASSERT_EQ(chain.size(), 8u);
  ASSERT_EQ(rest.size(), 12u);
  EXPECT_LT((chain.at(7).t - whole.at(7).t).norm(), 1e-12);
  const Rigid<3> end = chain.at(7) * rest.at(11);
  EXPECT_LT((end.t - wanted.t).norm(), 1e-6);
  EXPECT_LT((end.R - wanted.R).norm(), 1e-6);
  // Covariances of consecutive chains add up in the axes of one pose: both parts together have the information of the
  // whole.
  Problem<3> two;
  two.poses = {Rigid<3>(), chain.at(7), wanted};
  two.edges = {chain.edge(), rest.edge()};
  two.edges[0].to = 1;
  two.edges[1].from = 1;
  two.edges[1].to = 2;
  Problem<3> one;
  one.poses = {Rigid<3>(), wanted};
  one.edges = {whole.edge()};
  one.edges[0].to = 1;
  const double expected = cost(one, one.poses, Objective::Geodesic);
  EXPECT_NEAR(cost(two, two.poses, Objective::Geodesic), expected, 1e-4 * expected);
  // A part of a single step is not a chain.
  EXPECT_TRUE(whole.splitAfter(18, steps.data()).empty());
}

}  // namespace
}  // namespace pose_graph
