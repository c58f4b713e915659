// SPDX-License-Identifier: BSD-3-Clause
#include "odom_tie.hpp"

#include <gtest/gtest.h>

namespace pose_graph {
namespace {

using urban_nav_core::expSo3;

constexpr StampNs kStep = 50'000'000;

Pose at(int i) { return Pose(expSo3(Eigen::Vector3d(0.0, 0.0, 0.01 * i)), Eigen::Vector3d(0.1 * i, 0.02 * i, 0.0)); }

const Pose kMoved(expSo3(Eigen::Vector3d(0.1, -0.2, 1.0)), Eigen::Vector3d(5.0, -3.0, 0.3));

/// Poses first...last - 1, relaxed to somewhere else.
Track track(int first, int last, const SessionId& session = "a") {
  Track made;
  made.session = session;
  for (int i = first; i < last; ++i) {
    made.stamps.push_back(i * kStep);
    made.odom.push_back(at(first).inverse() * at(i));
    made.map.push_back(kMoved * at(i) * Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.001 * i, 0.0, 0.0)));
  }
  return made;
}

void hear(OdomTie& tie, int first, int last, StampNs offset = 0) {
  for (int i = first; i < last; ++i) tie.hear({i * kStep + offset, at(i)});
}

void expectTied(OdomTie& tie, const Track& track, int newest) {
  const auto T = tie.T_map_odom(&track);
  ASSERT_TRUE(T);
  const auto place = static_cast<std::size_t>(newest - track.stamps.front() / kStep);
  EXPECT_TRUE(isApprox(*T * at(newest), track.map[place], 1e-9));
}

TEST(OdomTie, isOfTheNewestPoseWhoseOdometryIsKnown) {
  OdomTie tie;
  hear(tie, 0, 50);
  expectTied(tie, track(0, 26), 25);
  expectTied(tie, track(0, 30), 29);
  expectTied(tie, track(0, 30), 29);
  hear(tie, 50, 60);
  expectTied(tie, track(0, 58), 57);
  expectTied(tie, track(0, 80), 59);
}

TEST(OdomTie, nothingIsKnownOfAnOdometryThatRanBeforeUntilItsStampsMeet) {
  OdomTie tie;
  EXPECT_FALSE(tie.T_map_odom(nullptr));
  hear(tie, 100, 130);
  EXPECT_FALSE(tie.T_map_odom(nullptr));
  const Track early = track(60, 100), late = track(60, 110);
  EXPECT_FALSE(tie.T_map_odom(&early));
  expectTied(tie, late, 109);
}

TEST(OdomTie, whereOdomBeginsTheMapDoes) {
  OdomTie tie;
  hear(tie, 0, 20);
  EXPECT_TRUE(isApprox(*tie.T_map_odom(nullptr), Pose(), 0.0));
}

TEST(OdomTie, aNewSessionIsTiedAtItsFirstPose) {
  OdomTie tie;
  hear(tie, 0, 100);
  expectTied(tie, track(0, 76), 75);
  Track next = track(75, 77, "b");
  for (Pose& pose : next.map) pose = kMoved * kMoved * pose;
  const Track empty = track(0, 0, "b");
  EXPECT_TRUE(tie.T_map_odom(&empty)) << "what it was";
  expectTied(tie, next, 76);
}

TEST(OdomTie, anOdometryThatBeginsAnewDoesSoAtTheNewestPose) {
  OdomTie tie;
  hear(tie, 0, 40);
  const Track before = track(0, 40);
  expectTied(tie, before, 39);
  hear(tie, 0, 20, 41 * kStep);
  EXPECT_TRUE(isApprox(*tie.T_map_odom(&before), before.map.back(), 0.0));
  Track after = before;
  after.stamps.push_back(42 * kStep);
  after.map.push_back(kMoved);
  EXPECT_TRUE(isApprox(*tie.T_map_odom(&after) * at(1), kMoved, 1e-9));
}

TEST(OdomTie, aRecordingThatBeginsAgainHasNothingToDoWithTheSessionBefore) {
  OdomTie tie;
  hear(tie, 0, 100);
  const Track before = track(0, 100), again = track(0, 10, "b");
  expectTied(tie, before, 99);
  hear(tie, 0, 30);
  EXPECT_TRUE(isApprox(*tie.T_map_odom(&before), Pose(), 0.0)) << "though its stamps are the same";
  expectTied(tie, again, 9);
}

TEST(OdomTie, aSessionOfAnEmptiedGraphMayHaveTheIdOfOneBefore) {
  OdomTie tie;
  hear(tie, 0, 100);
  expectTied(tie, track(0, 100), 99);
  hear(tie, 0, 1);
  tie.forgetSessions();
  EXPECT_FALSE(tie.T_map_odom(nullptr) && !isApprox(*tie.T_map_odom(nullptr), Pose(), 0.0));
  hear(tie, 1, 30);
  expectTied(tie, track(0, 10), 9);
}

TEST(OdomTie, isBounded) {
  OdomTie tie;
  hear(tie, 0, 20'000);
  const Track early = track(0, 100), late = track(0, 19'000);
  EXPECT_TRUE(isApprox(*tie.T_map_odom(&early), early.map.back(), 0.0)) << "that long ago is forgotten";
  expectTied(tie, late, 18'999);
}

}  // namespace
}  // namespace pose_graph
