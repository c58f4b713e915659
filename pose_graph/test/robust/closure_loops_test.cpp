// SPDX-License-Identifier: BSD-3-Clause
#include "robust/evidence/closure_loops.hpp"

#include <gtest/gtest.h>

#include "pose_graph/robust.hpp"
#include "support/drawn.hpp"
#include "urban_nav_core/testing/false_closures.hpp"
#include "urban_nav_core/testing/graphs.hpp"

namespace pose_graph {

using urban_nav_core::ClosureVerdict;

namespace {

using test::simulatedProblem;
using urban_nav_core::testing::addFalseClosures;
using urban_nav_core::testing::FalseClosures;
using urban_nav_core::testing::SimulatedGraph;

SimulatedGraph globe(double drawn, std::uint64_t seed) {
  auto noise = urban_nav_core::testing::evenNoise(0.05, 0.01);
  noise.drawn = drawn;
  return urban_nav_core::testing::sphereGraph(12, 24, 20.0, noise, seed);
}

struct Candidates {
  Problem<3> problem;
  std::vector<EdgeRole> roles;
  std::vector<int> edges;

  explicit Candidates(const SimulatedGraph& graph)
      : problem(simulatedProblem<3>(graph, deadReckoning(graph))), roles(rolesByNumbers(problem)) {
    for (std::size_t e = 0; e < roles.size(); ++e)
      if (roles[e] == EdgeRole::Candidate) edges.push_back(static_cast<int>(e));
  }
};

InformationScale estimateScale(const SimulatedGraph& graph) {
  const Candidates drawn(graph);
  const DeadReckoning<3> chains(drawn.problem, drawn.roles);
  return informationScale(ClosureLoops<3>(drawn.problem, drawn.edges, chains));
}

// The factor applies to variances; it is estimated from about a hundred loops.
TEST(InformationScale, IsThatOfTheNoise) {
  for (const double drawn : {0.1, 0.5, 1.0, 4.0}) {
    const double factor = estimateScale(globe(drawn, 3)).factor;
    EXPECT_GT(factor, 0.7 * drawn * drawn) << drawn;
    EXPECT_LT(factor, 1.4 * drawn * drawn) << drawn;
  }
}

TEST(InformationScale, IsEstimatedAmongAsManyFalseClosures) {
  for (const FalseClosures kind : {FalseClosures::Random, FalseClosures::Local, FalseClosures::RandomGrouped})
    for (const double drawn : {0.2, 1.0, 4.0}) {
      SimulatedGraph graph = globe(drawn, 5);
      addFalseClosures(graph, kind, graph.edges.size() - graph.truth.size(), 11);
      const InformationScale scale = estimateScale(graph);
      EXPECT_GT(scale.factor, 0.5 * drawn * drawn) << drawn << ' ' << static_cast<int>(kind);
      EXPECT_LT(scale.factor, 3.0 * drawn * drawn) << drawn << ' ' << static_cast<int>(kind);
    }
}

TEST(InformationScale, IsOneWithoutLoops) {
  SimulatedGraph graph = globe(4.0, 5);
  graph.edges.resize(graph.truth.size() - 1);
  EXPECT_EQ(estimateScale(graph).factor, 1.0);
}

// Few loops may deviate from the stated variance by chance, and must not loosen the tests.
TEST(InformationScale, DoesNotInferOverconfidenceFromFewLoops) {
  SimulatedGraph graph = globe(10.0, 5);
  graph.edges.resize(graph.truth.size() + 19);
  EXPECT_LE(estimateScale(graph).factor, 1.0);
}

// Information overconfident by a factor of four in all deviations: every true closure looks false with the stated
// covariance.
TEST(InformationScale, KeepsTrueClosuresWithOverconfidentInformation) {
  const SimulatedGraph clean = globe(4.0, 7);
  SimulatedGraph spoilt = clean;
  addFalseClosures(spoilt, FalseClosures::Random, (clean.edges.size() - clean.truth.size()) / 2, 11);
  for (const SimulatedGraph& graph : {clean, spoilt}) {
    const Candidates drawn(graph);
    const RobustSolution<3> robust = relaxRobust(drawn.problem, drawn.roles, {});
    std::size_t lost = 0, kept = 0;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      const bool accepted = robust.edges[e].verdict == ClosureVerdict::Accepted;
      lost += !graph.edges[e].wrong && !accepted;
      kept += graph.edges[e].wrong && accepted;
    }
    EXPECT_EQ(lost, 0u);
    EXPECT_EQ(kept, 0u);
    EXPECT_NEAR(robust.variance_factor, 16.0, 4.0);
  }
}

}  // namespace
}  // namespace pose_graph
