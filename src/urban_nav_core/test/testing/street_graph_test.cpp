// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/street_graph.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "urban_nav_core/testing/bands.hpp"

namespace urban_nav_core::testing {
namespace {

TEST(StreetGraph, RobotNeverMovesSideways) {
  const SimulatedGraph graph = streetGraph(20000, 100, streetNoise(), 1);
  double highest = 0.0, turned = 0.0;
  for (std::size_t i = 0; i + 1 < graph.truth.size(); ++i) {
    const Pose step = trueRelative(graph, i, i + 1);
    ASSERT_NEAR(step.t().x(), 0.05, 0.0005) << i;
    // A step along an arc leaves the first heading by half of its turn: 0.05^2 / (2 * 3.5 m).
    ASSERT_LT(std::abs(step.t().y()), 4e-4) << i;
    ASSERT_LT(std::abs(step.t().z()), 1e-4) << i;
    ASSERT_LT(angleBetween(Pose(), step), 0.05 / 3.5 + 1e-3) << i;
    highest = std::max(highest, std::abs(graph.truth[i].t().z()));
    turned += angleBetween(Pose(), step);
  }
  EXPECT_GT(highest, 0.5) << "hills";
  EXPECT_GT(turned, 10.0) << "turns";
}

TEST(StreetGraph, ClosuresJoinPassesInBothDirections) {
  const SimulatedGraph graph = streetGraph(50000, 300, streetNoise(), 2);
  ASSERT_EQ(graph.truth.size(), 50000u);
  ASSERT_EQ(graph.edges.size(), 49999u + 300u);
  int same = 0, opposite = 0;
  std::size_t last = 0;
  for (std::size_t i = 49999; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    EXPECT_EQ(edge.kind, GraphEdgeKind::Closure);
    EXPECT_GT(edge.b, edge.a + 600) << "more than 30 s apart";
    EXPECT_GE(edge.b, last) << "in the order of time";
    last = edge.b;
    const double angle = angleBetween(graph.truth[edge.a], graph.truth[edge.b]);
    const double apart = distanceBetween(graph.truth[edge.a], graph.truth[edge.b]);
    const bool back = angle > 1.0;
    ++(back ? opposite : same);
    EXPECT_NEAR(angle, back ? 3.14 : 0.0, 0.25);
    EXPECT_NEAR(apart, back ? 3.0 : 0.0, back ? 0.3 : 1.1) << "the other lane, or the same";
  }
  EXPECT_GT(same, 60);
  EXPECT_GT(opposite, 60);
}

TEST(StreetGraph, NoiseMatchesTheInformation) {
  const SimulatedGraph graph = streetGraph(20000, 200, streetNoise(), 3);
  double sums[2] = {0.0, 0.0}, counts[2] = {0.0, 0.0};
  for (const GraphEdge& edge : graph.edges) {
    const int kind = edge.kind == GraphEdgeKind::Chain ? 0 : 1;
    sums[kind] += edgeNees(graph, edge), ++counts[kind];
  }
  for (int kind : {0, 1}) EXPECT_TRUE(meanChiSquareFits(sums[kind] / counts[kind], 6, counts[kind]));
}

TEST(StreetGraph, ChainDriftsByItsStatedNoise) {
  const SimulatedGraph graph = streetGraph(20000, 0, streetNoise(), 4);
  const double off = distanceBetween(deadReckoning(graph).back(), graph.truth.back());
  EXPECT_GT(off, 0.1);
  EXPECT_LT(off, 50.0);
  GraphNoise exact = streetNoise();
  exact.drawn = 0.0;
  const SimulatedGraph clean = streetGraph(20000, 0, exact, 4);
  EXPECT_LT(distanceBetween(deadReckoning(clean).back(), clean.truth.back()), 1e-8);
}

TEST(StreetGraph, IsTheSameForTheSameSeedAlone) {
  const SimulatedGraph one = streetGraph(8000, 20, streetNoise(), 5), same = streetGraph(8000, 20, streetNoise(), 5);
  for (std::size_t i = 0; i < one.edges.size(); ++i) {
    ASSERT_TRUE(one.edges[i].a == same.edges[i].a && one.edges[i].b == same.edges[i].b);
    ASSERT_TRUE(isApprox(one.edges[i].T_a_b, same.edges[i].T_a_b, 0.0));
  }
  const SimulatedGraph other = streetGraph(8000, 20, streetNoise(), 6);
  EXPECT_GT(distanceBetween(one.truth.back(), other.truth.back()), 1.0);
}

TEST(StreetGraph, CountsRevisitedPlaces) {
  EXPECT_THROW(streetGraph(1000, 1, streetNoise(), 1), std::invalid_argument);
  EXPECT_EQ(streetGraph(1000, 0, streetNoise(), 1).edges.size(), 999u);
}

}  // namespace
}  // namespace urban_nav_core::testing
