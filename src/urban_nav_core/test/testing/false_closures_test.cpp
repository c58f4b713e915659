// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/false_closures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "urban_nav_core/testing/bands.hpp"
#include "urban_nav_core/testing/street_graph.hpp"

namespace urban_nav_core::testing {
namespace {

constexpr FalseClosures kAll[] = {FalseClosures::Random, FalseClosures::Local, FalseClosures::RandomGrouped,
                                  FalseClosures::LocalGrouped};

bool isGrouped(FalseClosures kind) {
  return kind == FalseClosures::RandomGrouped || kind == FalseClosures::LocalGrouped;
}
bool isLocal(FalseClosures kind) { return kind == FalseClosures::Local || kind == FalseClosures::LocalGrouped; }

TEST(FalseClosures, FollowTheDefinition) {
  for (const bool planar : {false, true}) {
    const SimulatedGraph clean = planar ? manhattanGraph(1500, 20, 0.5, evenNoise(0.05, 0.02), 1)
                                        : sphereGraph(30, 50, 50.0, evenNoise(0.05, 0.02), 1);
    const std::size_t before = clean.edges.size();
    for (const FalseClosures kind : kAll) {
      SimulatedGraph graph = clean;
      addFalseClosures(graph, kind, 1000, 7);
      ASSERT_EQ(graph.edges.size(), before + 1000);
      double places = 0.0, angles = 0.0, groups = 0.0;
      for (std::size_t i = before; i < graph.edges.size(); ++i) {
        const GraphEdge& edge = graph.edges[i];
        ASSERT_LT(edge.b, graph.truth.size());
        EXPECT_GT(edge.b, edge.a + 1);
        EXPECT_LE(edge.b, isLocal(kind) ? edge.a + 20 : graph.truth.size());
        EXPECT_EQ(edge.kind, GraphEdgeKind::Closure);
        EXPECT_EQ(edge.information, clean.edges[clean.truth.size() - 1].information) << "of the first closure";
        const Vector6d off = edgeError(graph, edge);
        EXPECT_EQ(edge.wrong, off.head<3>().norm() > 1.0 || off.tail<3>().norm() > 0.35);
        if (isGrouped(kind) && (i - before) % 10 != 0) {
          const GraphEdge& last = graph.edges[i - 1];
          EXPECT_TRUE(edge.a == last.a + 1 && edge.b == last.b + 1 && isApprox(edge.T_a_b, last.T_a_b, 0.0));
          continue;
        }
        const Matrix3d R = edge.T_a_b.R();
        places += edge.T_a_b.t().squaredNorm() / 0.09;
        const double yaw = std::atan2(R(1, 0), R(0, 0)), pitch = std::asin(-R(2, 0)),
                     roll = std::atan2(R(2, 1), R(2, 2));
        angles += (yaw * yaw + pitch * pitch + roll * roll) / (0.17453292519943295 * 0.17453292519943295);
        ++groups;
      }
      EXPECT_EQ(groups, isGrouped(kind) ? 100.0 : 1000.0);
      EXPECT_TRUE(meanChiSquareFits(places / groups, planar ? 2 : 3, groups, 0.999));
      EXPECT_TRUE(meanChiSquareFits(angles / groups, planar ? 1 : 3, groups, 0.999));
    }
  }
}

TEST(FalseClosures, ReachOverTheWholeGraphAndAreNearlyAllWrong) {
  SimulatedGraph graph = streetGraph(20000, 10, streetNoise(), 1);
  const std::size_t before = graph.edges.size();
  addFalseClosures(graph, FalseClosures::Random, 500, 3);
  std::size_t wrong = 0, far = 0;
  for (std::size_t i = before; i < graph.edges.size(); ++i) {
    wrong += graph.edges[i].wrong;
    far += graph.edges[i].b - graph.edges[i].a > 10000;
  }
  EXPECT_GT(wrong, 495u);
  EXPECT_NEAR(static_cast<double>(far), 125.0, 4.0 * std::sqrt(94.0)) << "a quarter, of variance 94";
}

TEST(FalseClosures, AreTheSameForTheSameSeedAlone) {
  SimulatedGraph one = sphereGraph(10, 20, 10.0, evenNoise(0.1, 0.01), 1), same = one, other = one;
  addFalseClosures(one, FalseClosures::RandomGrouped, 25, 1);
  addFalseClosures(same, FalseClosures::RandomGrouped, 25, 1);
  addFalseClosures(other, FalseClosures::RandomGrouped, 25, 2);
  EXPECT_EQ(one.edges.back().a, same.edges.back().a);
  EXPECT_TRUE(isApprox(one.edges.back().T_a_b, same.edges.back().T_a_b, 0.0));
  EXPECT_FALSE(isApprox(one.edges.back().T_a_b, other.edges.back().T_a_b, 1e-6));
}

TEST(FalseClosures, RefuseGraphsThatHaveNoPlaceForThem) {
  SimulatedGraph chain = gridGraph(10, 1, 1, 1.0, 1.0, evenNoise(0.1, 0.1), 1);
  EXPECT_THROW(addFalseClosures(chain, FalseClosures::Random, 1, 1), std::invalid_argument) << "no closure";
  SimulatedGraph small = gridGraph(3, 3, 1, 1.0, 1.0, evenNoise(0.1, 0.1), 1);
  EXPECT_THROW(addFalseClosures(small, FalseClosures::RandomGrouped, 1, 1, 8), std::invalid_argument);
  addFalseClosures(small, FalseClosures::LocalGrouped, 50, 1, 7);
  for (const GraphEdge& edge : small.edges) EXPECT_LT(edge.b, 9u);
}

TEST(AliasedClosures, AgreeWithEachOtherAndWithTheOdometryBetweenThem) {
  GraphNoise exact = streetNoise();
  exact.drawn = 0.0;
  SimulatedGraph graph = streetGraph(30000, 50, exact, 5);
  const std::size_t before = graph.edges.size();
  AliasOptions options;
  options.pairs = 4;
  options.closures = 15;
  addAliasedClosures(graph, options, 8);
  ASSERT_EQ(graph.edges.size(), before + 60);
  double sum = 0.0;
  for (std::size_t pair = 0; pair < 4; ++pair) {
    const std::size_t first = before + 15 * pair;
    const GraphEdge& one = graph.edges[first];
    for (std::size_t i = first; i < first + 15; ++i) {
      const GraphEdge& edge = graph.edges[i];
      EXPECT_TRUE(edge.wrong);
      EXPECT_LT(edge.a, edge.b);
      EXPECT_GT(distanceBetween(graph.truth[edge.a], graph.truth[edge.b]), 20.0);
      if (i == first) continue;
      // Around the two edges and the true paths between their ends, for either assignment of the ends.
      const bool turned = distanceBetween(graph.truth[edge.a], graph.truth[one.a]) > 10.0;
      const Pose T = turned ? edge.T_a_b.inverse() : edge.T_a_b;
      const std::size_t a = turned ? edge.b : edge.a, b = turned ? edge.a : edge.b;
      const Pose round = one.T_a_b.inverse() * trueRelative(graph, one.a, a) * T * trueRelative(graph, b, one.b);
      const double angle = angleBetween(Pose(), round);
      EXPECT_LT(angle, 0.1) << "0.01 rad about each axis of two edges";
      EXPECT_LT(round.t().norm(), 0.5);
      sum += angle * angle / (2.0 * 1e-4);
    }
  }
  EXPECT_GT(sum / 56.0, 1.5) << "3 by the noise";
  EXPECT_LT(sum / 56.0, 5.5);
}

TEST(AliasedClosures, RefuseATownThatIsTooSmall) {
  SimulatedGraph graph = gridGraph(4, 4, 4, 1.0, 1.0, evenNoise(0.1, 0.1), 1);
  EXPECT_THROW(addAliasedClosures(graph, {}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace urban_nav_core::testing
