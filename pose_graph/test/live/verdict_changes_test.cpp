// SPDX-License-Identifier: BSD-3-Clause
#include "live/verdict_changes.hpp"

#include <gtest/gtest.h>

#include "support/driven.hpp"

namespace pose_graph {
namespace {

constexpr const char* kCircleSession = "monday";

TEST(VerdictChanges, AreReportedOnceAndAgainWhenTheyChange) {
  PoseGraph graph{Parameters()};
  graph.beginSession(kCircleSession);
  for (int i = 0; i < 2 * testing::kLap; ++i) graph.addOdometry(kCircleSession, testing::stepAt(i));
  VerdictChanges changes;
  for (const int i : {10, 60, 90})
    graph.addClosure(testing::closureAt(kCircleSession, i, kCircleSession, i + testing::kLap));
  EXPECT_TRUE(changes.take(graph).empty()) << "not relaxed yet";
  graph.relax();
  const auto accepted = changes.take(graph);
  ASSERT_EQ(accepted.size(), 3u);
  for (const auto& each : accepted) EXPECT_EQ(each.verdict, ClosureVerdict::Accepted);
  EXPECT_TRUE(changes.take(graph).empty());

  const Closure right = testing::closureAt(kCircleSession, 30, kCircleSession, 30 + testing::kLap);
  Closure wrong = right;
  wrong.measured.T_a_b = wrong.measured.T_a_b * Pose(urban_nav_core::Quaterniond::Identity(), {4.0, 3.0, 0.0});
  graph.addClosure(wrong);
  graph.relax();
  const auto rejected = changes.take(graph);
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_EQ(rejected[0].verdict, ClosureVerdict::Rejected);
  EXPECT_EQ(rejected[0].a.stamp, wrong.a.stamp);
  EXPECT_EQ(rejected[0].b.stamp, wrong.b.stamp);
  EXPECT_EQ(rejected[0].source, "pose_graph");
  EXPECT_TRUE(rejected[0].measured.information.isZero());

  graph.addClosure(right);  // measured again
  graph.relax();
  const auto again = changes.take(graph);
  ASSERT_EQ(again.size(), 1u);
  EXPECT_EQ(again[0].verdict, ClosureVerdict::Accepted);
  changes.clear();
  EXPECT_EQ(changes.take(graph).size(), 4u);
}

}  // namespace
}  // namespace pose_graph
