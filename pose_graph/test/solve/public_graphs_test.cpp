// SPDX-License-Identifier: BSD-3-Clause
#include "support/public_graphs.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/solution.hpp"
#include "support/drawn.hpp"

namespace pose_graph::test {
namespace {

template <int D>
void expectOptima(const urban_nav_core::G2oGraph& graph, const PublicGraph& known) {
  const Problem<D> problem = makeProblem<D>(graph, known.name).problem;
  SolveOptions options;
  options.objective = Objective::Chordal;
  const Solution<D> chordal = solve(problem, options);
  EXPECT_NEAR(chordal.cost, known.chordal, 1e-6 * known.chordal);
  EXPECT_NEAR(cost(problem, chordal.poses, Objective::Chordal), known.chordal, 1e-6 * known.chordal);
  options.objective = Objective::G2o;
  const Solution<D> g2o = solve(problem, options);
  EXPECT_NEAR(g2o.cost, known.g2o, 1e-6 * known.g2o);
  EXPECT_EQ(chordal.ending, Ending::Converged);
  EXPECT_EQ(g2o.ending, Ending::Converged);
  // The geodesic optimum is the initial guess of the chordal one.
  options.objective = Objective::Geodesic;
  Problem<D> from_there = problem;
  from_there.poses = solve(problem, options).poses;
  options.objective = Objective::Chordal;
  options.start = Start::Vertices;
  EXPECT_NEAR(solve(from_there, options).cost, known.chordal, 1e-6 * known.chordal);
}

TEST(PublicGraphs, ReachTheirOptima) {
  const std::vector<PublicGraph> graphs = publicGraphs();
  if (graphs.empty()) GTEST_SKIP() << "URBAN_NAV_DATA names no folder with graphs";
  for (const PublicGraph& known : graphs) {
    SCOPED_TRACE(known.name);
    const auto graph = readPublic(known.name);
    if (!graph) GTEST_SKIP() << "xz is not installed";
    if (known.dimension == 2) expectOptima<2>(*graph, known);
    else expectOptima<3>(*graph, known);
  }
}

}  // namespace
}  // namespace pose_graph::test
