// SPDX-License-Identifier: BSD-3-Clause
#include "start/along_edges.hpp"

#include "support/drawn.hpp"

namespace pose_graph::test {
namespace {

template <int D>
void expectExactChains() {
  Dice dice(1);
  const Problem<D> exact = drawProblem<D>(dice, 25, 10, 0.0, 0.0);
  Problem<D> problem = exact;
  for (std::size_t i = 1; i < problem.poses.size(); ++i) problem.poses[i] = drawRigid<D>(dice, 9.0, 2.0);
  EXPECT_LT(largestDifference(posesAlongEdges(problem), exact.poses), 1e-10);
}
TEST(AlongEdges, ExactMeasurementsGiveThePoses) {
  expectExactChains<2>();
  expectExactChains<3>();
}

Edge<2> step(int from, int to, double x) {
  Edge<2> edge;
  edge.from = from;
  edge.to = to;
  edge.Z.t.x() = x;
  return edge;
}

TEST(AlongEdges, TheChainGoesFirst) {
  Problem<2> problem;
  problem.poses.resize(4);
  problem.edges = {step(0, 3, 100.0), step(0, 1, 1.0), step(2, 1, -1.0), step(2, 3, 1.0)};
  const std::vector<Rigid<2>> poses = posesAlongEdges(problem);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(poses[static_cast<std::size_t>(i)].t.x(), i);
}

TEST(AlongEdges, FixedPosesStayAndTheirOtherEdgesComeLast) {
  Problem<2> problem;
  problem.poses.resize(6);
  problem.poses[2].t.x() = 20.0;
  problem.fixed = {2, 5};
  problem.edges = {step(5, 0, -7.0), step(5, 4, 70.0), step(0, 1, 1.0), step(1, 2, 1.0), step(3, 4, 1.0)};
  const std::vector<Rigid<2>> poses = posesAlongEdges(problem);
  const double expected[] = {18.0, 19.0, 20.0, 69.0, 70.0, 0.0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(poses[i].t.x(), expected[i]) << i;
}

TEST(AlongEdges, OtherEdgesBridgeABrokenChain) {
  Problem<2> problem;
  problem.poses.resize(5);
  problem.edges = {step(0, 1, 1.0), step(3, 4, 1.0), step(4, 0, 7.0)};
  problem.poses[2].t.x() = 55.0;  // no edge leads there
  const std::vector<Rigid<2>> poses = posesAlongEdges(problem);
  const double expected[] = {0.0, 1.0, 55.0, -8.0, -7.0};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(poses[i].t.x(), expected[i]);
}

TEST(AlongEdges, KnownPosesStay) {
  Problem<2> problem;
  problem.poses.resize(6);
  problem.poses[2].t.x() = 10.0;
  problem.poses[4].t.x() = 30.0;
  problem.edges = {step(0, 1, 1.0), step(1, 2, 1.0), step(2, 3, 1.0), step(3, 4, 1.0), step(4, 5, 1.0)};
  const std::vector<Rigid<2>> poses = posesAlongEdges(problem, {0, 0, 1, 0, 1, 0});
  EXPECT_EQ(poses[2].t.x(), 10.0);
  EXPECT_EQ(poses[4].t.x(), 30.0);
  EXPECT_EQ(poses[0].t.x(), 8.0);
  EXPECT_EQ(poses[5].t.x(), 31.0);
  EXPECT_TRUE(poses[3].t.x() == 11.0 || poses[3].t.x() == 29.0);
}

}  // namespace
}  // namespace pose_graph::test
