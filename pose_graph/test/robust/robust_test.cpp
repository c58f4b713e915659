// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/robust.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/drawn.hpp"
#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/false_closures.hpp"
#include "urban_nav_core/testing/graphs.hpp"

namespace pose_graph {

using urban_nav_core::ClosureVerdict;

namespace {

using test::simulatedProblem;
using urban_nav_core::testing::addFalseClosures;
using urban_nav_core::testing::FalseClosures;
using urban_nav_core::testing::GraphEdge;
using urban_nav_core::testing::SimulatedGraph;

constexpr FalseClosures kKinds[] = {FalseClosures::Random, FalseClosures::Local, FalseClosures::RandomGrouped,
                                    FalseClosures::LocalGrouped};

SimulatedGraph town(std::uint64_t seed) {
  return urban_nav_core::testing::manhattanGraph(600, 12, 0.5, urban_nav_core::testing::evenNoise(0.05, 0.01), seed);
}
SimulatedGraph globe(std::uint64_t seed) {
  return urban_nav_core::testing::sphereGraph(12, 24, 20.0, urban_nav_core::testing::evenNoise(0.05, 0.01), seed);
}
std::size_t listClosures(const SimulatedGraph& graph) { return graph.edges.size() - (graph.truth.size() - 1); }

struct Count {
  int wrong_kept = 0, wrong = 0, true_lost = 0, right = 0;
};
template <int D>
Count count(const SimulatedGraph& graph, const RobustSolution<D>& robust) {
  Count made;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const bool accepted = robust.edges[e].verdict == ClosureVerdict::Accepted;
    if (graph.edges[e].wrong) {
      ++made.wrong;
      made.wrong_kept += accepted;
    } else {
      ++made.right;
      made.true_lost += !accepted;
    }
  }
  return made;
}

template <int D>
void undoesFalseClosures(SimulatedGraph (*draw)(std::uint64_t), double metres) {
  for (const FalseClosures kind : kKinds) {
    SimulatedGraph graph = draw(7);
    const std::size_t closures = listClosures(graph);
    addFalseClosures(graph, kind, closures / 2, 11);
    const Problem<D> problem = simulatedProblem<D>(graph, deadReckoning(graph));
    const RobustSolution<D> robust = relaxRobust(problem, rolesByNumbers(problem), {});
    const Count seen = count(graph, robust);
    EXPECT_GT(seen.wrong, static_cast<int>(closures / 4));
    EXPECT_EQ(seen.wrong_kept, 0) << "kind " << static_cast<int>(kind);
    EXPECT_LE(seen.true_lost, seen.right / 50) << "kind " << static_cast<int>(kind);
    for (std::size_t i = 0; i < graph.truth.size(); ++i)
      EXPECT_LT((robust.solution.poses[i].t - toRigid<D>(graph.truth[i]).t).norm(), metres) << i;
  }
}

TEST(Robust, FalseClosuresOfATownAreUndone) { undoesFalseClosures<2>(town, 1.0); }
TEST(Robust, FalseClosuresOnASphereAreUndone) { undoesFalseClosures<3>(globe, 1.0); }

TEST(Robust, AGraphWithoutFalseClosuresEndsWhereThePlainSolverDoes) {
  const SimulatedGraph graph = town(3);
  const Problem<2> problem = simulatedProblem<2>(graph, deadReckoning(graph));
  const RobustSolution<2> robust = relaxRobust(problem, rolesByNumbers(problem), {});
  EXPECT_EQ(count(graph, robust).true_lost, 0);
  EXPECT_LT(test::largestDifference<2>(robust.solution.poses, solve(problem, {}).poses), 1e-3);
  EXPECT_GT(robust.variance_factor, 0.8) << "the noise is what the information says";
}

TEST(Robust, ExactMeasurementsStayExact) {
  const SimulatedGraph graph = urban_nav_core::testing::manhattanGraph(
      200, 8, 0.5,
      [] {
        auto noise = urban_nav_core::testing::evenNoise(0.05, 0.01);
        noise.drawn = 0.0;
        return noise;
      }(),
      5);
  const Problem<2> problem = simulatedProblem<2>(graph, deadReckoning(graph));
  const RobustSolution<2> robust = relaxRobust(problem, rolesByNumbers(problem), {});
  EXPECT_EQ(count(graph, robust).true_lost, 0);
  for (std::size_t i = 0; i < graph.truth.size(); ++i)
    EXPECT_LT((robust.solution.poses[i].t - toRigid<2>(graph.truth[i]).t).norm(), 1e-6);
}

// Most residuals are a fifth of the stated deviation, one is three times as large.
TEST(Robust, LowInformationIsTakenAsStated) {
  SimulatedGraph graph = urban_nav_core::testing::manhattanGraph(
      600, 12, 0.5,
      [] {
        auto noise = urban_nav_core::testing::evenNoise(0.05, 0.01);
        noise.drawn = 0.2;
        return noise;
      }(),
      7);
  const std::size_t chain = graph.truth.size() - 1, odd = chain + listClosures(graph) / 2,
                    closures = listClosures(graph);
  addFalseClosures(graph, FalseClosures::Random, closures / 4, 11);
  Problem<2> problem = simulatedProblem<2>(graph, deadReckoning(graph));
  problem.edges[odd].Z.t[0] += 3.0 / std::sqrt(problem.edges[odd].information(0, 0));
  const RobustSolution<2> robust = relaxRobust(problem, rolesByNumbers(problem), {});
  const Count seen = count(graph, robust);
  EXPECT_LT(robust.variance_factor, 0.1);
  EXPECT_EQ(robust.edges[odd].verdict, ClosureVerdict::Accepted) << robust.edges[odd].chi2;
  EXPECT_LE(seen.true_lost, static_cast<int>(closures / 50));
  EXPECT_EQ(seen.wrong_kept, 0);
}

TEST(Robust, PlacesWithoutHeadingsAreEnough) {
  SimulatedGraph graph = town(9);
  const std::size_t chain = graph.truth.size() - 1;
  addFalseClosures(graph, FalseClosures::Random, listClosures(graph) / 5, 2);
  Problem<2> problem = simulatedProblem<2>(graph, deadReckoning(graph));
  for (std::size_t e = chain; e < problem.edges.size(); ++e)
    problem.edges[e].information = Eigen::Vector3d(100.0, 100.0, 0.0).asDiagonal();
  const RobustSolution<2> robust = relaxRobust(problem, rolesByNumbers(problem), {});
  const Count seen = count(graph, robust);
  EXPECT_LE(seen.wrong_kept, seen.wrong / 50);
  EXPECT_LE(seen.true_lost, seen.right / 20);
  EXPECT_EQ(robust.edges.back().dof, 2);
  EXPECT_TRUE(test::allFinite<2>(robust.solution.poses));
}

// Two drives through the same town, joined by closures only.
struct TwoDrives {
  SimulatedGraph graph = town(13);
  Problem<2> problem;
  std::vector<EdgeRole> roles;
  std::size_t second = graph.truth.size() / 2;

  explicit TwoDrives(std::size_t closures_between) {
    std::vector<GraphEdge> kept;
    std::size_t between = 0;
    for (const GraphEdge& edge : graph.edges) {
      const bool across = (edge.a < second) != (edge.b < second);
      if (across && edge.b == edge.a + 1) continue;  // the step from one drive to the other
      if (across && between++ >= closures_between) continue;
      kept.push_back(edge);
    }
    graph.edges = kept;
    problem = simulatedProblem<2>(graph, graph.truth);
    // Unknown relative pose.
    for (std::size_t i = second; i < problem.poses.size(); ++i) problem.poses[i].t.x() += 500.0;
    roles = rolesByNumbers(problem);
  }
};

TEST(Robust, DrivesAreJoinedByClosuresThatAgree) {
  const TwoDrives drives(1000);
  const RobustSolution<2> robust = relaxRobust(drives.problem, drives.roles, {});
  EXPECT_EQ(robust.solution.components, 1);
  EXPECT_LE(count(drives.graph, robust).true_lost, 3);
  for (std::size_t i = 0; i < drives.graph.truth.size(); ++i)
    EXPECT_LT((robust.solution.poses[i].t - toRigid<2>(drives.graph.truth[i]).t).norm(), 1.0) << i;
}

TEST(Robust, OneClosureAloneJoinsNothing) {
  const TwoDrives drives(1);
  const RobustSolution<2> robust = relaxRobust(drives.problem, drives.roles, {});
  EXPECT_EQ(robust.solution.components, 2);
  int without_witness = 0;
  for (const EdgeAssessment& edge : robust.edges) without_witness += edge.reason == Reason::NoWitness;
  EXPECT_EQ(without_witness, 1);
}

TEST(Robust, AnAssertedEdgeStaysAndNamesWhatContradictsIt) {
  const SimulatedGraph graph = town(21);
  Problem<2> problem = simulatedProblem<2>(graph, deadReckoning(graph));
  std::vector<EdgeRole> roles = rolesByNumbers(problem);
  Edge<2> lie = problem.edges.back();  // a false closure
  const std::size_t truth = problem.edges.size() - 1;
  lie.Z.t.x() += 4.0;
  lie.information *= 100.0;
  problem.edges.push_back(lie);
  roles.push_back(EdgeRole::Asserted);
  const RobustSolution<2> robust = relaxRobust(problem, roles, {});
  EXPECT_EQ(robust.edges.back().verdict, ClosureVerdict::Accepted);
  EXPECT_EQ(robust.edges.back().weight, 1.0);
  const std::vector<int>& against = robust.edges.back().contradicted_by;
  EXPECT_NE(std::find(against.begin(), against.end(), static_cast<int>(truth)), against.end());
  EXPECT_LT(against.size(), problem.edges.size() / 4);
  EXPECT_EQ(robust.edges[truth].verdict, ClosureVerdict::Rejected);

  problem.edges.back() = problem.edges[truth];
  EXPECT_TRUE(relaxRobust(problem, roles, {}).edges.back().contradicted_by.empty())
      << "what is true is not contradicted";
}

TEST(Robust, SameBytesWhateverTheThreads) {
  SimulatedGraph graph = town(4);
  addFalseClosures(graph, FalseClosures::RandomGrouped, 50, 3);
  const Problem<2> problem = simulatedProblem<2>(graph, deadReckoning(graph));
  const auto run = [&](int threads) {
    const urban_nav_core::ThreadLimit limit(threads);
    return relaxRobust(problem, rolesByNumbers(problem), {});
  };
  const RobustSolution<2> one = run(1), four = run(4);
  EXPECT_EQ(test::largestDifference<2>(one.solution.poses, four.solution.poses), 0.0);
  for (std::size_t e = 0; e < one.edges.size(); ++e) EXPECT_EQ(one.edges[e].verdict, four.edges[e].verdict);
}

TEST(Robust, RolesFollowTheNumbers) {
  Problem<2> problem;
  problem.poses.resize(4);
  const auto edge = [](int from, int to) { return Edge<2>{from, to, {}, TangentMatrix<2>::Identity()}; };
  problem.edges = {edge(0, 1), edge(2, 1), edge(1, 2), edge(0, 3)};
  EXPECT_EQ(rolesByNumbers(problem),
            (std::vector<EdgeRole>{EdgeRole::Trusted, EdgeRole::Trusted, EdgeRole::Candidate, EdgeRole::Candidate}));
  problem.edges = {edge(0, 2), edge(2, 0), edge(1, 3), edge(3, 0), edge(0, 2)};
  EXPECT_EQ(rolesByNumbers(problem), (std::vector<EdgeRole>{EdgeRole::Trusted, EdgeRole::Candidate, EdgeRole::Trusted,
                                                            EdgeRole::Trusted, EdgeRole::Candidate}));
}

TEST(Robust, GraphsWithoutCandidatesAreRelaxed) {
  Problem<3> problem;
  problem.poses.resize(3);
  problem.edges = {{0, 1, {}, TangentMatrix<3>::Identity()}, {1, 2, {}, TangentMatrix<3>::Zero()}};
  const RobustSolution<3> robust = relaxRobust(problem, rolesByNumbers(problem), {});
  EXPECT_EQ(robust.edges[1].verdict, ClosureVerdict::Accepted);
  EXPECT_TRUE(test::allFinite<3>(robust.solution.poses));
}

}  // namespace
}  // namespace pose_graph
