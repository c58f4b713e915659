// SPDX-License-Identifier: BSD-3-Clause
#include "graph/odometry_variance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pose_graph/robust.hpp"
#include "support/drawn.hpp"
#include "urban_nav_core/testing/graphs.hpp"

namespace pose_graph {
namespace {

// A sphere graph whose odometry errors are `drawn` times the stated ones; closure errors are as stated.
struct ScaledErrors {
  Problem<3> problem;
  std::size_t chains = 0;
  std::vector<double> weights;
  Solution<3> solution;

  explicit ScaledErrors(double drawn, std::size_t closures = 1000, std::uint64_t seed = 3) {
    auto noise = urban_nav_core::testing::evenNoise(0.02, 0.004);
    noise.drawn = drawn;
    const auto graph = urban_nav_core::testing::sphereGraph(12, 24, 20.0, noise, seed);
    problem = test::simulatedProblem<3>(graph, deadReckoning(graph));
    chains = graph.truth.size() - 1;
    problem.edges.resize(std::min(problem.edges.size(), chains + closures));
    for (std::size_t e = chains; e < problem.edges.size(); ++e) problem.edges[e].information /= drawn * drawn;
    weights.assign(problem.edges.size(), 1.0);
    solution = solve(problem, {}, weights);
  }
  double factor(double largest = std::numeric_limits<double>::infinity()) {
    return takeOdometryVariance(problem, chains, weights, {}, solution, largest);
  }
};

TEST(OdometryVariance, FindsTheFactorOfOverconfidentOdometry) {
  for (const double drawn : {1.5, 3.0}) {
    ScaledErrors graph(drawn);
    const double factor = graph.factor();
    EXPECT_GT(factor, 0.8 * drawn * drawn);
    EXPECT_LT(factor, 1.25 * drawn * drawn);
    // The returned solution is the one of the problem with that factor.
    SolveOptions from_here;
    from_here.start = Start::Vertices;
    graph.problem.poses = graph.solution.poses;
    EXPECT_NEAR(solve(graph.problem, from_here, graph.weights).cost, graph.solution.cost, 1e-6 * graph.solution.cost);
  }
}

TEST(OdometryVariance, LeavesTrueCovariancesAlone) {
  ScaledErrors graph(1.0);
  EXPECT_LT(graph.factor(), 1.15);
  EXPECT_GE(ScaledErrors(0.5).factor(), 1.0) << "and careful ones";
}

TEST(OdometryVariance, IsNoLargerThanAllowed) {
  auto noise = urban_nav_core::testing::evenNoise(0.02, 0.004);
  noise.drawn = 5.0;
  const auto graph = urban_nav_core::testing::sphereGraph(12, 24, 20.0, noise, 3);
  const std::size_t chains = graph.truth.size() - 1;
  Problem<3> problem = test::simulatedProblem<3>(graph, deadReckoning(graph));
  for (std::size_t e = chains; e < problem.edges.size(); ++e) problem.edges[e].information /= noise.drawn * noise.drawn;
  const std::vector<double> weights(problem.edges.size(), 1.0);
  Solution<3> solution = solve(problem, {}, weights);
  EXPECT_EQ(takeOdometryVariance(problem, chains, weights, {}, solution, 9.0), 9.0);
  SolveOptions from_here;
  from_here.start = Start::Vertices;
  problem.poses = solution.poses;
  EXPECT_NEAR(solve(problem, from_here, weights).cost, solution.cost, 1e-6 * solution.cost);
}

TEST(OdometryVariance, IsNotDecidedByOneClosure) {
  // Its six degrees of freedom have the same weight as the stated variance: on average half way.
  double mean = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) mean += ScaledErrors(3.0, 1, seed).factor() / 20.0;
  EXPECT_GT(mean, 3.0);
  EXPECT_LT(mean, 7.0);
  ScaledErrors none(3.0, 0);
  const double before = none.problem.edges.front().information(0, 0);
  EXPECT_EQ(none.factor(), 1.0);
  EXPECT_EQ(none.problem.edges.front().information(0, 0), before);
}

TEST(OdometryVariance, DoesNothingWhereClosuresLeaveDirectionsFree) {
  ScaledErrors graph(3.0);
  // Two parts joined by planes only.
  graph.problem.edges[graph.chains / 2].information.setZero();
  for (std::size_t e = graph.chains; e < graph.problem.edges.size(); ++e) {
    graph.problem.edges[e].information.setZero();
    graph.problem.edges[e].information(2, 2) = 100.0;
  }
  graph.solution = solve(graph.problem, {}, graph.weights);
  const double factor = graph.factor();
  EXPECT_TRUE(std::isfinite(factor));
  EXPECT_GE(factor, 1.0);
  EXPECT_TRUE(test::allFinite<3>(graph.solution.poses));
}

}  // namespace
}  // namespace pose_graph
