// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/common_error.hpp"

#include "support/driven.hpp"

namespace pose_graph {
namespace {

using testing::kPeriod;
using urban_nav_core::ConsideredConstant;
using urban_nav_core::RelativePose;
using urban_nav_core::Vector6d;

ConsideredConstant disparityAt(int step, double used, double mean, double sigma) {
  return {"disparity", used, mean, sigma, (Vector6d() << 1e-3, 2e-4, 0.0, 0.0, 0.0, 1e-5 * step).finished()};
}

/// A session whose steps, except the first, contain an estimate of the offset with decreasing uncertainty.
void driveKnowing(PoseGraph& graph, const SessionId& session, int steps, double mean, double sigma) {
  for (int i = 0; i < steps; ++i) {
    RelativePose step = testing::stepAt(i);
    if (i > 0) step.constants = {disparityAt(i, 0.02, mean * i / (steps - 1.0), sigma * (steps - i))};
    graph.addOdometry(session, step);
  }
}

TEST(CommonErrorsOfAGraph, FollowTheEstimateOfTheNewestStep) {
  PoseGraph graph{Parameters()};
  driveKnowing(graph, "a", 5, 0.05, 0.01);
  const std::vector<CommonError<3>> errors = graph.commonErrors();
  ASSERT_EQ(errors.size(), 2U);
  for (const CommonError<3>& each : errors) {
    ASSERT_EQ(each.of_edge.size(), 4U + 1U);
    EXPECT_EQ(each.of_edge[0], Vector6d::Zero());
  }
  for (int i = 1; i < 5; ++i) {
    const Vector6d per_px = disparityAt(i, 0.0, 0.0, 0.0).sensitivity;
    EXPECT_LT((errors[0].of_edge[static_cast<std::size_t>(i)] - 0.01 * per_px).norm(), 1e-15);
    EXPECT_LT((errors[1].of_edge[static_cast<std::size_t>(i)] - (0.02 - 0.05) * per_px).norm(), 1e-15);
  }
}

TEST(CommonErrorsOfAGraph, AreSharedBySessionsOfOneRigAlone) {
  PoseGraph graph{Parameters()};
  driveKnowing(graph, "a", 4, 0.02, 0.01);
  driveKnowing(graph, "b", 4, 0.02, 0.03);
  std::vector<CommonError<3>> errors = graph.commonErrors();
  ASSERT_EQ(errors.size(), 1U) << "steps were made with what is known now";
  EXPECT_EQ(errors[0].of_edge[2], errors[0].of_edge[6]) << "by the session that knows it best";
  graph.setRig("b", "another one");
  errors = graph.commonErrors();
  ASSERT_EQ(errors.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const bool of_a = errors[i].of_edge[2].norm() > 0.0;
    EXPECT_NE(of_a, errors[i].of_edge[6].norm() > 0.0);
    EXPECT_NEAR(errors[i].of_edge[of_a ? 2 : 6].norm() / disparityAt(2, 0.0, 0.0, 0.0).sensitivity.norm(),
                of_a ? 0.01 : 0.03, 1e-12);
  }
}

TEST(CommonErrorsOfAGraph, OfTheScaleAreInWhatCamerasMeasure) {
  PoseGraph graph{Parameters()};
  for (int i = 0; i < 6; ++i) {
    RelativePose step = testing::stepAt(i);
    step.constants = {{"scale", 0.0, 0.0, 0.01, Vector6d::Unit(0) * 0.1}};
    graph.addOdometry("a", step);
  }
  Closure stereo = testing::closureAt("a", 0, "a", 5), icp = testing::closureAt("a", 0, "a", 5);
  stereo.measured.T_a_b = Pose(urban_nav_core::Quaterniond::Identity(), {0.5, 0.25, 0.0});
  icp.kind = EdgeKind::Icp;
  graph.addClosure(stereo);
  graph.addClosure(icp);
  const std::vector<CommonError<3>> errors = graph.commonErrors();
  ASSERT_EQ(errors.size(), 1U);
  ASSERT_EQ(errors[0].of_edge.size(), 8U);
  EXPECT_NEAR(errors[0].of_edge[3][0], 1e-3, 1e-15);
  EXPECT_LT((errors[0].of_edge[6] - 0.01 * (Vector6d() << 0.5, 0.25, 0, 0, 0, 0).finished()).norm(), 1e-15);
  EXPECT_EQ(errors[0].of_edge[7], Vector6d::Zero());
}

TEST(CommonErrorsOfAGraph, SkipGapsAndMoveNoPose) {
  PoseGraph graph{Parameters()}, plain{Parameters()};
  for (int i = 0; i < 30; ++i) {
    RelativePose step = testing::stepAt(i);
    if (i == 10) continue;
    plain.addOdometry("a", step);
    step.constants = {disparityAt(i, 0.0, 0.0, 0.1)};
    graph.addOdometry("a", step);
  }
  for (PoseGraph* each : {&graph, &plain}) {
    each->addClosure(testing::closureAt("a", 0, "a", 8));
    each->relax();
  }
  testing::expectSameMap(graph, plain);
  EXPECT_TRUE(plain.commonErrors().empty());
  const std::vector<CommonError<3>> errors = graph.commonErrors();
  ASSERT_EQ(errors.size(), 1U);
  ASSERT_EQ(errors[0].of_edge.size(), graph.problem().edges.size() - 1) << "closures without an error stand last";
  EXPECT_NEAR(errors[0].of_edge[10][5], 0.1 * 11e-5, 1e-15) << "the step after the gap";
}

}  // namespace
}  // namespace pose_graph
