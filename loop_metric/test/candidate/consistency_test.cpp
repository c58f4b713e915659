// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/candidate/consistency.hpp"

#include <gtest/gtest.h>

#include "support/line_place_data.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

constexpr StampNs kClosureSecond = 1'000'000'000;

Pose closurePose(double x, double y) { return Pose(urban_nav_core::Quaterniond::Identity(), {x, y, 0.0}); }

/// Two passes along the same metres, and the closures between corresponding metres of both.
struct TwoPasses {
  testing::LinePlaceData around;
  std::vector<MetricClosure> closures;
  TwoPasses() {
    std::vector<Pose> poses;
    for (int i = 0; i < 20; ++i) poses.push_back(closurePose(i, 0.0));
    for (int i = 0; i < 20; ++i) poses.push_back(closurePose(i, 0.5));
    around.drive("day", poses, 0.01, 0.001);
    for (int i = 0; i < 10; ++i)
      closures.push_back(closure(i, 20 + i, Pose(urban_nav_core::Quaterniond::Identity(), {0, 0.5, 0})));
  }
  static MetricClosure closure(StampNs a, StampNs b, const Pose& T_a_b) {
    MetricClosure result;
    result.a = {"day", a * kClosureSecond};
    result.b = {"day", b * kClosureSecond};
    result.measured.T_a_b = T_a_b;
    result.measured.information.diagonal() << Eigen::Vector3d::Constant(1e4), Eigen::Vector3d::Constant(1e6);
    result.verdict = ClosureVerdict::Accepted;
    return result;
  }
};

TEST(Consistency, ClosuresThatAgreeStay) {
  TwoPasses passes;
  const auto counts = pairwiseConsistencyCheck(passes.closures, passes.around, {});
  for (std::size_t i = 0; i < counts.size(); ++i) {
    EXPECT_EQ(passes.closures[i].verdict, ClosureVerdict::Accepted);
    EXPECT_EQ(counts[i].agreeing, 9);
    EXPECT_EQ(counts[i].contradicting, 0);
  }
}

TEST(Consistency, WhatItsNeighboursContradictIsRejectedAndTheyStay) {
  TwoPasses passes;
  passes.closures[4].measured.T_a_b = closurePose(2.0, 0.5);
  passes.closures[7].measured.T_a_b = closurePose(0.0, -3.0);
  pairwiseConsistencyCheck(passes.closures, passes.around, {});
  for (std::size_t i = 0; i < passes.closures.size(); ++i) {
    const bool wrong = i == 4 || i == 7;
    EXPECT_EQ(passes.closures[i].verdict, wrong ? ClosureVerdict::Rejected : ClosureVerdict::Accepted) << i;
    EXPECT_EQ(passes.closures[i].reason_name, wrong ? "contradicted" : "") << i;
    EXPECT_EQ(passes.closures[i].measured.information.isZero(0.0), wrong) << i;
  }
}

TEST(Consistency, TwoWithoutAThirdAreBothKept) {
  TwoPasses passes;
  passes.closures.resize(2);
  passes.closures[1].measured.T_a_b = closurePose(2.0, 0.5);
  pairwiseConsistencyCheck(passes.closures, passes.around, {});
  EXPECT_EQ(passes.closures[0].verdict, ClosureVerdict::Accepted);
  EXPECT_EQ(passes.closures[1].verdict, ClosureVerdict::Accepted);
}

TEST(Consistency, AFreeDirectionContradictsNothing) {
  TwoPasses passes;
  passes.closures[4].measured.T_a_b = closurePose(2.0, 0.5);
  passes.closures[4].measured.information.row(0).setZero();
  passes.closures[4].measured.information.col(0).setZero();
  pairwiseConsistencyCheck(passes.closures, passes.around, {});
  EXPECT_EQ(passes.closures[4].verdict, ClosureVerdict::Accepted);
}

TEST(Consistency, OtherSessionsAndLongPathsAreNoNeighbours) {
  TwoPasses passes;
  passes.closures[3].b.session = "another";
  passes.closures[3].measured.T_a_b = closurePose(9.0, 9.0);
  const auto counts = pairwiseConsistencyCheck(passes.closures, passes.around, {});
  EXPECT_EQ(counts[3].agreeing + counts[3].contradicting, 0);
  EXPECT_TRUE(pairwiseConsistencyCheck(passes.closures = {}, passes.around, {}).empty());
}

}  // namespace
}  // namespace loop_metric
