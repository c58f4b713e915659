// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/graphs.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "urban_nav_core/testing/bands.hpp"

namespace urban_nav_core::testing {
namespace {

GraphNoise unevenNoise() {
  GraphNoise noise;
  noise.chain << 0.02, 0.05, 0.01, 0.002, 0.03, 0.3;
  noise.closure << 0.1, 0.2, 0.4, 0.2, 0.1, 0.05;
  return noise;
}

struct Shape {
  const char* name;
  std::size_t poses;
  std::function<SimulatedGraph(const GraphNoise&, std::uint64_t seed)> make;
};

std::vector<Shape> shapes() {
  return {{"sphere", 600,
           [](const GraphNoise& noise, std::uint64_t seed) { return sphereGraph(20, 30, 50.0, noise, seed); }},
          {"grid", 210,
           [](const GraphNoise& noise, std::uint64_t seed) { return gridGraph(5, 6, 7, 1.0, 0.6, noise, seed); }},
          {"planar grid", 300,
           [](const GraphNoise& noise, std::uint64_t seed) { return planarGridGraph(20, 15, 2.0, 0.5, noise, seed); }},
          {"manhattan", 800,
           [](const GraphNoise& noise, std::uint64_t seed) { return manhattanGraph(800, 12, 0.7, noise, seed); }}};
}

TEST(Graphs, ChainComesFirstAndEdgesJoinPosesThatAreThere) {
  for (const Shape& shape : shapes()) {
    const SimulatedGraph graph = shape.make(unevenNoise(), 1);
    ASSERT_EQ(graph.truth.size(), shape.poses) << shape.name;
    ASSERT_GT(graph.edges.size(), graph.truth.size()) << shape.name;
    for (std::size_t i = 0; i < graph.edges.size(); ++i) {
      const GraphEdge& edge = graph.edges[i];
      const bool inChain = i + 1 < graph.truth.size();
      EXPECT_EQ(edge.kind, inChain ? GraphEdgeKind::Chain : GraphEdgeKind::Closure);
      if (inChain) EXPECT_TRUE(edge.a == i && edge.b == i + 1) << shape.name << " " << i;
      else ASSERT_TRUE(edge.a < graph.truth.size() && edge.b < graph.truth.size() && edge.b != edge.a) << shape.name;
      EXPECT_FALSE(edge.wrong);
    }
  }
}

TEST(Graphs, NoiseMatchesTheInformation) {
  for (const Shape& shape : shapes()) {
    const SimulatedGraph graph = shape.make(unevenNoise(), 2);
    double sums[2] = {0.0, 0.0}, counts[2] = {0.0, 0.0};
    Vector6d squares = Vector6d::Zero();
    for (const GraphEdge& edge : graph.edges) {
      const int kind = edge.kind == GraphEdgeKind::Chain ? 0 : 1;
      sums[kind] += edgeNees(graph, edge), ++counts[kind];
      squares += edge.information * edgeError(graph, edge).cwiseAbs2();
    }
    const double dof = graph.planar ? 3.0 : 6.0;
    for (int kind : {0, 1}) EXPECT_TRUE(meanChiSquareFits(sums[kind] / counts[kind], dof, counts[kind])) << shape.name;
    for (int axis = 0; axis < 6; ++axis) {
      if (graph.planar && axis >= 2 && axis <= 4) EXPECT_EQ(squares[axis], 0.0) << shape.name;
      else
        EXPECT_TRUE(meanChiSquareFits(squares[axis] / (counts[0] + counts[1]), 1, counts[0] + counts[1], 0.999))
            << shape.name << " axis " << axis;
    }
  }
}

TEST(Graphs, ErrorsAreThoseOfTheSuitesConvention) {
  SimulatedGraph graph = sphereGraph(3, 10, 5.0, unevenNoise(), 3);
  for (const GraphEdge& edge : graph.edges) {
    const Pose exact = graph.truth[edge.a].inverse() * graph.truth[edge.b];
    EXPECT_TRUE(isApprox(trueRelative(graph, edge.a, edge.b), exact, 1e-12));
    EXPECT_LT((edgeError(graph, edge) - boxMinus(edge.T_a_b, exact)).norm(), 1e-12);
  }
}

TEST(Graphs, WithoutNoiseTheChainLeadsToTheTruthAndClosuresAgree) {
  for (const Shape& shape : shapes()) {
    GraphNoise noise = unevenNoise();
    noise.drawn = 0.0;
    const SimulatedGraph graph = shape.make(noise, 4);
    const std::vector<Pose> reckoned = deadReckoning(graph);
    ASSERT_EQ(reckoned.size(), graph.truth.size());
    for (std::size_t i = 0; i < reckoned.size(); ++i)
      ASSERT_TRUE(isApprox(reckoned[i], graph.truth[i], 1e-9)) << shape.name << " " << i;
    for (const GraphEdge& edge : graph.edges) {
      EXPECT_LT(edgeError(graph, edge).norm(), 1e-9);
      EXPECT_GT(edge.information(5, 5), 0.0) << "kept";
    }
  }
}

TEST(Graphs, AreTheSameForTheSameSeedAlone) {
  for (const Shape& shape : shapes()) {
    const SimulatedGraph one = shape.make(unevenNoise(), 5), same = shape.make(unevenNoise(), 5),
                         other = shape.make(unevenNoise(), 6);
    ASSERT_EQ(one.edges.size(), same.edges.size());
    for (std::size_t i = 0; i < one.edges.size(); ++i) {
      EXPECT_TRUE(one.edges[i].a == same.edges[i].a && one.edges[i].b == same.edges[i].b);
      EXPECT_TRUE(isApprox(one.edges[i].T_a_b, same.edges[i].T_a_b, 0.0));
    }
    EXPECT_FALSE(isApprox(one.edges[0].T_a_b, other.edges[0].T_a_b, 1e-9)) << shape.name;
  }
}

TEST(Graphs, ASphereHasHeadingsAlongItsRoundsAndClosuresToTheNext) {
  const SimulatedGraph graph = sphereGraph(50, 50, 50.0, evenNoise(0.1, 0.01), 1);
  EXPECT_EQ(graph.edges.size(), 4949u) << "as sphere2500 has";
  for (std::size_t i = 0; i < graph.truth.size(); ++i) {
    const Pose& T = graph.truth[i];
    EXPECT_NEAR(T.t().norm(), 50.0, 1e-9);
    EXPECT_TRUE(T.R().col(2).isApprox(T.t() / 50.0, 1e-9));
    if (i > 1000 && i < 1500) {
      EXPECT_GT(trueRelative(graph, i, i + 1).t().x(), 0.99 * distanceBetween(T, graph.truth[i + 1]));
    }
  }
}

TEST(Graphs, AGridIsALatticeWithEveryNeighbourAsDenseAsAsked) {
  const SimulatedGraph all = gridGraph(4, 3, 5, 2.0, 1.0, evenNoise(0.1, 0.1), 1);
  EXPECT_EQ(all.edges.size(), 3u * 3 * 5 + 4 * 2 * 5 + 4 * 3 * 4);
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (const GraphEdge& edge : all.edges) {
    EXPECT_NEAR(distanceBetween(all.truth[edge.a], all.truth[edge.b]), 2.0, 1e-12);
    EXPECT_TRUE(pairs.insert(std::minmax(edge.a, edge.b)).second) << "twice";
  }
  EXPECT_EQ(gridGraph(4, 3, 5, 2.0, 0.0, evenNoise(0.1, 0.1), 1).edges.size(), 59u);
  for (std::size_t i = 0; i + 1 < all.truth.size(); ++i)
    EXPECT_NEAR(trueRelative(all, i, i + 1).t().x(), 2.0, 1e-12) << "x along the path";
}

TEST(Graphs, AManhattanStaysInTownAndClosesWhereItWasBefore) {
  const SimulatedGraph graph = manhattanGraph(2000, 15, 1.0, evenNoise(0.05, 0.02), 9);
  std::set<std::size_t> headings;
  for (const Pose& T : graph.truth) {
    EXPECT_TRUE(T.t().x() >= 0.0 && T.t().x() <= 14.0 && T.t().y() >= 0.0 && T.t().y() <= 14.0 && T.t().z() == 0.0);
  }
  for (const GraphEdge& edge : graph.edges) {
    const double length = distanceBetween(graph.truth[edge.a], graph.truth[edge.b]);
    EXPECT_NEAR(length, edge.kind == GraphEdgeKind::Chain ? 1.0 : 0.0, 1e-9);
    EXPECT_LT(edge.a, edge.b);
    if (edge.kind == GraphEdgeKind::Closure)
      headings.insert(static_cast<std::size_t>(angleBetween(graph.truth[edge.a], graph.truth[edge.b]) + 0.1));
  }
  EXPECT_EQ(headings.size(), 3u) << "revisited at 0, 90 and 180 deg";
  EXPECT_EQ(graph.edges.size(), 1999 + 2000 - 225u) << "each visit but the first of a crossing";
}

}  // namespace
}  // namespace urban_nav_core::testing
