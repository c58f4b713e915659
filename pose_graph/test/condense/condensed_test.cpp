// SPDX-License-Identifier: BSD-3-Clause
#include "condense/condensed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "condense/solve_condensed.hpp"
#include "pose_graph/graph_file.hpp"
#include "urban_nav_core/testing/street_graph.hpp"

namespace pose_graph {
namespace {

using urban_nav_core::Matrix6d;
using urban_nav_core::testing::SimulatedGraph;

Problem<3> problemFrom(const SimulatedGraph& graph) {
  Problem<3> problem;
  for (const urban_nav_core::Pose& pose : deadReckoning(graph)) problem.poses.push_back(toRigid<3>(pose));
  for (const auto& edge : graph.edges) {
    Edge<3> made{static_cast<int>(edge.a), static_cast<int>(edge.b), toRigid<3>(edge.T_a_b), {}};
    Matrix6d axes = Matrix6d::Zero();
    axes.topLeftCorner<3, 3>() = axes.bottomRightCorner<3, 3>() = made.Z.R;
    made.information = axes.transpose() * edge.information * axes;
    problem.edges.push_back(made);
  }
  return problem;
}

// The same drive projected to the plane.
Problem<2> flattened(const Problem<3>& problem) {
  Problem<2> made;
  const auto flat = [](const Rigid<3>& T) {
    const double heading = std::atan2(T.R(1, 0), T.R(0, 0));
    Rigid<2> result;
    result.R << std::cos(heading), -std::sin(heading), std::sin(heading), std::cos(heading);
    result.t = T.t.head<2>();
    return result;
  };
  for (const Rigid<3>& pose : problem.poses) made.poses.push_back(flat(pose));
  for (const Edge<3>& edge : problem.edges)
    made.edges.push_back({edge.from, edge.to, flat(edge.Z), Eigen::Vector3d(1e4, 2e4, 1e5).asDiagonal()});
  return made;
}

const SimulatedGraph& condensedDrive() {
  static const SimulatedGraph graph =
      urban_nav_core::testing::streetGraph(12000, 40, urban_nav_core::testing::streetNoise(), 3);
  return graph;
}

// Solves the full graph: a weight that differs from one in its last bit excludes an edge from chains.
template <int D>
std::vector<double> wholeGraph(const Problem<D>& problem) {
  return std::vector<double>(problem.edges.size(), 1.0 + 1e-15);
}

template <int D>
void expectSamePlaces(const std::vector<Rigid<D>>& a, const std::vector<Rigid<D>>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_LT((a[i].t - b[i].t).norm(), tolerance) << i;
    ASSERT_LT((a[i].R - b[i].R).norm(), tolerance) << i;
  }
}

template <int D>
void expectWhatTheWholeGraphGives(const Problem<D>& problem, Start start) {
  SolveOptions options;
  options.start = start;
  options.tolerance = 1e-13;
  const auto condensed = solveCondensed(problem, options, {});
  ASSERT_TRUE(condensed);
  EXPECT_EQ(condensed->ending, Ending::Converged);
  ASSERT_FALSE(solveCondensed(problem, options, wholeGraph(problem)));
  const Solution<D> whole = solve(problem, options, wholeGraph(problem));
  EXPECT_NEAR(condensed->cost, whole.cost, 1e-7 * whole.cost);
  expectSamePlaces<D>(condensed->poses, whole.poses, 1e-4);
}

TEST(Condensed, IsTheWholeGraphsOptimum) {
  expectWhatTheWholeGraphGives<3>(problemFrom(condensedDrive()), Start::Auto);
  expectWhatTheWholeGraphGives<3>(problemFrom(condensedDrive()), Start::Vertices);
  expectWhatTheWholeGraphGives<2>(flattened(problemFrom(condensedDrive())), Start::Auto);
}

TEST(Condensed, TakesEdgesThatRunBackwards) {
  Problem<3> problem = problemFrom(condensedDrive());
  const Problem<3> forwards = problem;
  for (std::size_t e = 0; e < problem.edges.size(); e += 3) {
    Edge<3>& edge = problem.edges[e];
    std::swap(edge.from, edge.to);
    edge.Z = edge.Z.inverse();
    // Isotropic noise, because information seen from the other end is rotated and has a lever arm, which this edge
    // cannot represent.
    edge.information = Eigen::Matrix<double, 6, 1>(1e6, 1e6, 1e6, 1e7, 1e7, 1e7).asDiagonal();
  }
  expectWhatTheWholeGraphGives<3>(problem, Start::Auto);
}

TEST(Condensed, HasNoErrorWithoutNoise) {
  urban_nav_core::testing::GraphNoise none = urban_nav_core::testing::streetNoise();
  none.drawn = 0.0;
  const SimulatedGraph graph = urban_nav_core::testing::streetGraph(12000, 40, none, 5);
  const Problem<3> problem = problemFrom(graph);
  const auto solution = solveCondensed(problem, {}, {});
  ASSERT_TRUE(solution);
  EXPECT_LT(solution->cost, 1e-9);
  for (std::size_t i = 0; i < graph.truth.size(); ++i)
    ASSERT_LT((solution->poses[i].t - graph.truth[i].t()).norm(), 1e-6) << i;
}

TEST(Condensed, ComesBackFromABendOfTheStart) {
  Problem<3> problem = problemFrom(condensedDrive());
  const auto straight = solveCondensed(problem, {}, {});
  // Odometry rotates 60 deg too far in the middle, so the initial guess is far off.
  Eigen::AngleAxisd turn(1.05, Eigen::Vector3d::UnitZ());
  SolveOptions options;
  options.start = Start::Vertices;
  for (std::size_t i = problem.poses.size() / 2; i < problem.poses.size(); ++i) {
    problem.poses[i].R = turn.toRotationMatrix() * problem.poses[i].R;
    problem.poses[i].t = turn.toRotationMatrix() * problem.poses[i].t;
  }
  const auto bent = solveCondensed(problem, options, {});
  ASSERT_TRUE(straight && bent);
  EXPECT_NEAR(bent->cost, straight->cost, 1e-5 * straight->cost);
}

TEST(Chains, HoldEveryPoseAndEdgeOnce) {
  const Problem<3> problem = problemFrom(condensedDrive());
  std::vector<char> invertible(problem.edges.size(), 1);
  invertible[5000] = 0;
  const Chains chains = findChains(problem, invertible);
  std::multiset<int> poses(chains.core.begin(), chains.core.end()),
      edges(chains.core_edges.begin(), chains.core_edges.end());
  for (std::size_t s = 0; s < chains.size(); ++s) {
    int at = chains.begin[s];
    for (std::size_t l = static_cast<std::size_t>(chains.first[s]); l < static_cast<std::size_t>(chains.first[s + 1]);
         ++l) {
      const Link& link = chains.links[l];
      const Edge<3>& edge = problem.edges[static_cast<std::size_t>(link.edge)];
      EXPECT_EQ(link.against ? edge.to : edge.from, at);
      at = link.pose;
      edges.insert(link.edge);
      if (l + 1 < static_cast<std::size_t>(chains.first[s + 1])) poses.insert(link.pose);
    }
    EXPECT_TRUE(std::binary_search(chains.core.begin(), chains.core.end(), at));
  }
  for (const Chains::Twig& twig : chains.twigs) {
    poses.insert(twig.link.pose);
    edges.insert(twig.link.edge);
  }
  EXPECT_EQ(poses.size(), problem.poses.size());
  EXPECT_EQ(std::set<int>(poses.begin(), poses.end()).size(), problem.poses.size());
  EXPECT_EQ(edges.size(), problem.edges.size());
  EXPECT_EQ(std::set<int>(edges.begin(), edges.end()).size(), problem.edges.size());
  EXPECT_TRUE(std::binary_search(chains.core_edges.begin(), chains.core_edges.end(), 5000));
  EXPECT_LT(chains.core.size(), 100u);
}

Problem<2> shape(int poses, const std::vector<std::pair<int, int>>& pairs) {
  Problem<2> problem;
  problem.poses.resize(static_cast<std::size_t>(poses));
  for (const auto& [from, to] : pairs) problem.edges.push_back({from, to, {}, Eigen::Matrix3d::Identity()});
  return problem;
}

TEST(Chains, FixedPosesAreInTheCore) {
  Problem<2> path;
  path.poses.resize(9);
  for (int i = 1; i < 9; ++i) path.edges.push_back({i - 1, i, {}, Eigen::Matrix3d::Identity()});
  const std::vector<char> invertible(8, 1);
  path.fixed = {2, 6};
  const Chains made = findChains(path, invertible);
  EXPECT_EQ(made.core, (std::vector<int>{2, 6}));
  ASSERT_EQ(made.size(), 1U);
  EXPECT_EQ(made.begin[0], 2);
  EXPECT_EQ(made.end(0), 6);
  EXPECT_EQ(made.twigs.size(), 4U);
  EXPECT_TRUE(made.core_edges.empty());
}

TEST(Chains, HandleTreesAndRings) {
  const auto find = [](const Problem<2>& problem) {
    return findChains(problem, std::vector<char>(problem.edges.size(), 1));
  };
  const Chains tree = find(shape(5, {{0, 1}, {1, 2}, {1, 3}, {4, 3}}));
  EXPECT_EQ(tree.core.size(), 1u);
  EXPECT_EQ(tree.twigs.size(), 4u);
  const Chains ring = find(shape(6, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {5, 4}}));
  EXPECT_EQ(ring.core.size(), 3u);  // two of the ring, one of the pair
  EXPECT_EQ(ring.size(), 1u);
  EXPECT_EQ(ring.core_edges.size(), 1u);
  const Chains twice = find(shape(3, {{0, 1}, {0, 1}, {1, 2}, {2, 0}}));
  EXPECT_EQ(twice.size() + twice.core_edges.size(), 3u);
  const Chains lone = find(shape(2, {}));
  EXPECT_EQ(lone.core.size(), 2u);
}

TEST(Condensed, SolvesTreesRingsAndTwins) {
  for (const auto& pairs : std::vector<std::vector<std::pair<int, int>>>{
           {{0, 1}, {1, 2}, {1, 3}, {4, 3}}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}, {{0, 1}, {2, 3}}}) {
    Problem<2> problem = shape(5, pairs);
    for (std::size_t e = 0; e < problem.edges.size(); ++e) {
      problem.edges[e].Z.t = {1.0, 0.1 * static_cast<double>(e)};
      problem.edges[e].Z.R = Eigen::Rotation2Dd(1.2).toRotationMatrix();
    }
    const Solution<2> condensed = solve(problem, {}), whole = solve(problem, {}, wholeGraph(problem));
    EXPECT_NEAR(condensed.cost, whole.cost, 1e-6 + 1e-6 * whole.cost);
    expectSamePlaces<2>(condensed.poses, whole.poses, 1e-3);
  }
}

}  // namespace
}  // namespace pose_graph
