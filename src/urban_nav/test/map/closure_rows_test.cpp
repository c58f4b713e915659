// SPDX-License-Identifier: BSD-3-Clause
#include "map/closure_rows.hpp"

#include <gtest/gtest.h>

namespace urban_nav {
namespace {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureRow;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;

const Pose kMeasuredPose(urban_nav_core::Quaterniond(0.6, 0.0, 0.0, 0.8), {1.0, 2.0, 3.0});

ClosureRow givenRow() {
  ClosureRow row;
  row.a = {"monday", 10};
  row.b = {"tuesday", 20};
  row.probability = 0.75;
  row.T_a_b = kMeasuredPose;
  row.where = "c.csv:2";
  return row;
}

/// As loop_metric returns a closure.
MetricClosure measuredClosure(ClosureVerdict verdict) {
  MetricClosure closure = toMetricClosure(givenRow());
  closure.verdict = verdict;
  closure.method = ClosureMethod::Icp;
  closure.evidence = "tests\n";
  closure.source = "loop_metric";
  if (verdict == ClosureVerdict::Rejected) {
    closure.reason_name = "odometry";
    closure.sentence = "too far off";
    closure.measured.information.setZero();
  }
  return closure;
}

TEST(ClosureRowsTest, TransformFromAFileIsAcceptedWithTheStatedDeviations) {
  ClosureRow row = givenRow();
  row.sigma_m = 0.1;
  row.sigma_rad = 0.01;
  const MetricClosure closure = toMetricClosure(row);
  EXPECT_EQ(closure.a, row.a);
  EXPECT_EQ(closure.b, row.b);
  EXPECT_EQ(closure.probability, 0.75);
  EXPECT_EQ(closure.source, "c.csv:2");
  EXPECT_EQ(closure.method, ClosureMethod::None) << "the file names none";
  EXPECT_EQ(closure.verdict, ClosureVerdict::Accepted);
  EXPECT_FALSE(isMeasured(closure));
  EXPECT_FALSE(closure.odometry_gate);
  const auto& information = closure.measured.information;
  EXPECT_TRUE(information.isDiagonal(0.0));
  EXPECT_DOUBLE_EQ(information(0, 0), 100.0);
  EXPECT_DOUBLE_EQ(information(2, 2), 100.0);
  EXPECT_DOUBLE_EQ(information(3, 3), 10000.0);
  EXPECT_DOUBLE_EQ(toMetricClosure(givenRow()).measured.information(0, 0), 16.0) << "0.25 m where the file states none";
}

TEST(ClosureRowsTest, CandidateHasNeitherVerdictNorTransform) {
  ClosureRow row = givenRow();
  row.T_a_b.reset();
  row.method = ClosureMethod::Stereo;
  const MetricClosure closure = toMetricClosure(row);
  EXPECT_EQ(closure.verdict, ClosureVerdict::Waiting);
  EXPECT_TRUE(closure.measured.information.isZero(0.0));
  EXPECT_FALSE(isMeasured(closure));
  EXPECT_FALSE(toRow(closure).verdict);
  EXPECT_FALSE(toRow(closure).T_a_b);
  EXPECT_EQ(toRow(closure).method, ClosureMethod::Stereo) << "as the file has it";
  const MetricClosure proposed = toCandidate({{"monday", 1}, {"monday", 2}, 0.5}, "places");
  EXPECT_EQ(proposed.verdict, ClosureVerdict::Waiting);
  EXPECT_EQ(proposed.method, ClosureMethod::None);
  EXPECT_EQ(proposed.probability, 0.5);
}

TEST(ClosureRowsTest, MeasuredClosuresHaveTheVerdictOfTheirStage) {
  const ClosureRow accepted = toRow(measuredClosure(ClosureVerdict::Accepted));
  EXPECT_EQ(accepted.verdict, ClosureVerdict::Accepted);
  EXPECT_EQ(accepted.method, ClosureMethod::Icp);
  EXPECT_EQ(accepted.reason, "");
  EXPECT_EQ(accepted.T_a_b->matrix(), kMeasuredPose.matrix());
  const ClosureRow rejected = toRow(measuredClosure(ClosureVerdict::Rejected));
  EXPECT_EQ(rejected.verdict, ClosureVerdict::Rejected);
  EXPECT_EQ(rejected.method, ClosureMethod::None);
  EXPECT_EQ(rejected.reason, "odometry: too far off");
  EXPECT_FALSE(rejected.T_a_b);
}

TEST(ClosureRowsTest, GraphHasTheLastWord) {
  const MetricClosure closure = measuredClosure(ClosureVerdict::Accepted);
  const ClosureRow waiting = toRow(closure, {7, ClosureVerdict::Waiting, "alone", 0.25});
  EXPECT_EQ(waiting.verdict, ClosureVerdict::Rejected) << "the file has accepted and rejected alone";
  EXPECT_EQ(waiting.reason, "alone");
  EXPECT_EQ(waiting.weight, 0.25);
  EXPECT_TRUE(waiting.T_a_b) << "the transform is known, whatever the graph makes of it";
  EXPECT_EQ(toRow(closure, {7, ClosureVerdict::Accepted, "", 1.0}).verdict, ClosureVerdict::Accepted);
}

TEST(ClosureRowsTest, PrintsVerdictsWhereTheGraphHasGivenThem) {
  const MetricClosure given = toMetricClosure(givenRow());
  const std::string before = printClosureRows({given}, {});
  EXPECT_NE(before.find("monday,10,tuesday,20,0.75,none,,,1,2,3,"), std::string::npos) << before;
  const std::string after = printClosureRows({given}, {{1, ClosureVerdict::Accepted, "agrees", 0.5}});
  EXPECT_NE(after.find("monday,10,tuesday,20,0.75,none,accepted,agrees,1,2,3,"), std::string::npos) << after;
  EXPECT_NE(after.find(",0.5\n"), std::string::npos) << after;
}

}  // namespace
}  // namespace urban_nav
