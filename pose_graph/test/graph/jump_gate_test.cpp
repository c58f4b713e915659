// SPDX-License-Identifier: BSD-3-Clause
#include "graph/jump_gate.hpp"

#include "../support/driven.hpp"

namespace pose_graph {
namespace {

using testing::closureAt;
using testing::drive;
using testing::kLap;

constexpr int kDriven = 4 * kLap;

/// A closure to the pose two laps ago, more than 0.5 m from odometry. `alone`: within the odometry gate, so that it
/// needs no confirmation.
Closure large(int a, bool alone = false) {
  Closure closure = closureAt("a", a, "a", a + 2 * kLap);
  closure.odometry_gate = alone;
  return closure;
}

Closure wrong(int a, double ahead, double sideways) {
  Closure closure = large(a);
  closure.measured.T_a_b = Pose(Eigen::Matrix3d::Identity(), Eigen::Vector3d(ahead, sideways, 0.0));
  return closure;
}

// Steps with a large covariance: odometry is consistent with large corrections.
PoseGraph driven() {
  PoseGraph graph{Parameters()};
  for (int i = 0; i < kDriven; ++i) {
    urban_nav_core::RelativePose step = testing::stepAt(i);
    step.T_from_to =
        step.T_from_to * Pose(urban_nav_core::expSo3(Eigen::Vector3d(0, 0, -1e-3)), Eigen::Vector3d::Zero());
    step.covariance *= 100.0;
    step.drift_covariance *= 100.0;
    graph.addOdometry("a", step);
  }
  return graph;
}

bool isAccepted(const PoseGraph& graph, ClosureId id) {
  return graph.closures().at(id).verdict == ClosureVerdict::Accepted && graph.closures().at(id).weight > 0.0;
}

TEST(JumpGate, ASecondOneThatAgreesEndsTheWaitAtOnce) {
  PoseGraph live = driven(), batch = driven();
  const Pose before = live.tracks()[0].map.back();
  const ClosureId first = live.addClosure(large(20));
  const Relaxed alone = live.update();
  EXPECT_EQ(alone.waiting, 1u);
  EXPECT_FALSE(alone.needs_batch) << "the batch could not say more";
  EXPECT_TRUE(isApprox(live.tracks()[0].map.back(), before, 1e-9));
  const ClosureId second = live.addClosure(large(50));
  const Relaxed both = live.update();
  EXPECT_TRUE(both.needs_batch) << "no set of closures was weighed";
  EXPECT_TRUE(isAccepted(live, first));
  EXPECT_TRUE(isAccepted(live, second));
  ASSERT_TRUE(both.correction);
  EXPECT_EQ(both.correction->causing_edges.size(), 2u);
  for (const int a : {20, 50}) batch.addClosure(large(a));
  EXPECT_EQ(batch.relax().accepted, 2u);
  for (std::size_t i = 0; i < live.tracks()[0].map.size(); i += 10)
    EXPECT_TRUE(isApprox(live.tracks()[0].map[i], batch.tracks()[0].map[i], 1e-2)) << i;
}

TEST(JumpGate, AnInconsistentClosureConfirmsNothing) {
  PoseGraph live = driven();
  const ClosureId false_one = live.addClosure(wrong(30, 0.0, 2.0));
  live.update();
  const Pose before = live.tracks()[0].map.back();
  const ClosureId first = live.addClosure(large(20));
  EXPECT_EQ(live.update().waiting, 2u);
  EXPECT_TRUE(isApprox(live.tracks()[0].map.back(), before, 1e-9)) << "both were taken back";
  const ClosureId second = live.addClosure(large(50));
  live.update();
  EXPECT_TRUE(isAccepted(live, first));
  EXPECT_TRUE(isAccepted(live, second));
  EXPECT_FALSE(isAccepted(live, false_one));
}

TEST(JumpGate, AClosureWithinTheOdometryGateConfirms) {
  PoseGraph live = driven();
  const ClosureId first = live.addClosure(large(20));
  live.update();
  EXPECT_FALSE(isAccepted(live, first));
  live.addClosure(large(50, true));
  EXPECT_EQ(live.update().accepted, 2u);
  EXPECT_TRUE(isAccepted(live, first));
}

TEST(JumpGate, MoreThanAreTriedAreForTheBatch) {
  PoseGraph live = driven();
  int a = 10;
  for (const auto& [ahead, sideways] :
       {std::pair(1.5, 0.0), std::pair(-1.5, 0.0), std::pair(0.0, 1.5), std::pair(0.0, -1.5)})
    live.addClosure(wrong(a += 10, ahead, sideways));
  const Relaxed crowd = live.update();
  EXPECT_EQ(crowd.waiting, 4u);
  EXPECT_FALSE(crowd.needs_batch) << "each was tried beside those before it";
  live.addClosure(large(60));
  EXPECT_TRUE(live.update().needs_batch);
}

}  // namespace
}  // namespace pose_graph
