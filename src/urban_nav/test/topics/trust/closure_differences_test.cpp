// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/closure_differences.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

constexpr urban_nav_core::StampNs kOneSecond = 1'000'000'000;

Pose step() { return Pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ())), {1.0, 0.0, 0.0}); }

/// Ten steps of a second along a bend, with a scale whose error is 1 % of each length.
SessionOdometry drive() {
  SessionOdometry run;
  run.settled.resize(11);
  for (std::size_t i = 1; i < run.settled.size(); ++i) {
    SmoothedFrame& frame = run.settled[i];
    frame.stamp = static_cast<urban_nav_core::StampNs>(i) * kOneSecond;
    frame.from_previous.from = frame.stamp - kOneSecond;
    frame.from_previous.to = frame.stamp;
    frame.from_previous.T_from_to = step();
    frame.from_previous.covariance = frame.from_previous.drift_covariance = 1e-8 * Matrix6d::Identity();
    Vector6d sensitivity = Vector6d::Zero();
    sensitivity.head<3>() = step().t();
    frame.from_previous.constants.push_back({"scale", 0.0, 0.0, 0.01, sensitivity});
  }
  return run;
}

Pose between(int steps) {
  Pose pose;
  for (int i = 0; i < steps; ++i) pose = pose * step();
  return pose;
}

MetricClosure measuredClosure(const Pose& T_a_b, const Matrix6d& information) {
  MetricClosure built;
  built.a = {"s", 2 * kOneSecond};
  built.b = {"s", 8 * kOneSecond};
  built.measured = {T_a_b, information};
  built.method = urban_nav_core::ClosureMethod::Icp;
  return built;
}

ClosureAssessment verdict(ClosureVerdict of_graph) {
  ClosureAssessment built;
  built.verdict = of_graph;
  return built;
}

std::vector<urban_nav_trust::ClosureDifference> compare(const MetricClosure& each,
                                                        ClosureVerdict of_graph = ClosureVerdict::Accepted) {
  return closureDifferences("s", drive(), {each}, {verdict(of_graph)});
}

TEST(ClosureDifferences, AreClosureLessOdometryWithBothCovariances) {
  Vector6d moved;
  moved << 0.2, -0.1, 0.05, 0.0, 0.0, 0.02;
  const auto found = compare(measuredClosure(boxPlus(between(6), moved), 1e4 * Matrix6d::Identity()));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].by_laser);
  EXPECT_NEAR(found[0].difference.norm(), moved.norm(), 1e-9);
  EXPECT_EQ(found[0].interval.from, 2 * kOneSecond);
  EXPECT_NEAR(found[0].closure.trace(), 6e-4, 1e-12);
  // A common scale moves the end by 1 % of where it is.
  EXPECT_NEAR(found[0].odometry.trace(), 1e-4 * between(6).t().squaredNorm(), 1e-5 * between(6).t().squaredNorm());
}

TEST(ClosureDifferences, LeaveOutWhatTheClosureDidNotMeasure) {
  Matrix6d information = 1e4 * Matrix6d::Identity();
  information.row(0).setZero();
  information.col(0).setZero();
  Vector6d moved = Vector6d::Zero();
  moved[0] = 5.0;
  const auto found = compare(measuredClosure(boxPlus(between(6), moved), information));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].difference.size(), 5);
  EXPECT_NEAR(found[0].difference.norm(), 0.0, 1e-9);
}

TEST(ClosureDifferences, AClosureBackInTimeHasTheSameCovariance) {
  const Matrix6d information = 1e4 * Matrix6d::Identity();
  MetricClosure back = measuredClosure(between(6).inverse(), information);
  std::swap(back.a, back.b);
  const auto forth = compare(measuredClosure(between(6), information)), found = compare(back);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].difference.norm(), 0.0, 1e-9);
  EXPECT_NEAR(found[0].odometry.trace(), forth[0].odometry.trace(), 0.05 * forth[0].odometry.trace());
}

TEST(ClosureDifferences, AreOfAcceptedClosuresOfTheSessionAlone) {
  const MetricClosure each = measuredClosure(between(6), 1e4 * Matrix6d::Identity());
  EXPECT_TRUE(compare(each, ClosureVerdict::Rejected).empty());
  EXPECT_TRUE(compare(measuredClosure(between(6), Matrix6d::Zero())).empty());
  EXPECT_TRUE(closureDifferences("other", drive(), {each}, {verdict(ClosureVerdict::Accepted)}).empty());
  EXPECT_TRUE(closureDifferences("s", drive(), {each}, {}).empty()) << "not relaxed";
  EXPECT_TRUE(closureDifferences("s", {}, {each}, {verdict(ClosureVerdict::Accepted)}).empty());
}

TEST(PlaneDifferences, AreOfAllPlanesBetweenPassesOfTheSession) {
  const urban_nav_input::testing::TemporaryFolder folder;
  urban_nav_store::Store store(folder.file("s.db"), urban_nav_store::Access::Write);
  constexpr const char *kThis = "aaaaaaaaaaaaaaaa", *kOther = "bbbbbbbbbbbbbbbb";
  for (const char* id : {kThis, kOther}) store.sessions().put({id, "monday", "", "", 0, true});
  const auto put = [&](const char* b, urban_nav_store::EdgeKind kind, ClosureVerdict of_graph, int to) {
    urban_nav_store::Edge edge;
    edge.a = {kThis, 2 * kOneSecond};
    edge.b = {b, to * kOneSecond};
    edge.kind = kind;
    edge.source = "laser_mapper";
    edge.verdict = of_graph;
    edge.measured = {between(to - 2), 1e4 * Matrix6d::Identity()};
    store.graph().put(edge);
  };
  using urban_nav_store::EdgeKind;
  put(kThis, EdgeKind::Plane, ClosureVerdict::Accepted, 8);
  put(kThis, EdgeKind::Plane, ClosureVerdict::Rejected, 9);
  put(kThis, EdgeKind::Icp, ClosureVerdict::Accepted, 7);
  put(kOther, EdgeKind::Plane, ClosureVerdict::Accepted, 6);
  const auto found = planeDifferences(store, kThis, drive());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].difference.norm(), 0.0, 1e-9);
  EXPECT_EQ(found[1].interval.to, 9 * kOneSecond);
  EXPECT_TRUE(planeDifferences(store, kThis, {}).empty());
}

}  // namespace
}  // namespace urban_nav
