// SPDX-License-Identifier: BSD-3-Clause
#include "live/map_to_odom_estimator.hpp"

#include <gtest/gtest.h>

namespace pose_graph {
namespace {

using urban_nav_core::expSo3;

constexpr StampNs kVoPeriod = 50'000'000;

Pose at(int i) { return Pose(expSo3(Eigen::Vector3d(0.0, 0.0, 0.01 * i)), Eigen::Vector3d(0.1 * i, 0.02 * i, 0.0)); }

const Pose kMoved(expSo3(Eigen::Vector3d(0.1, -0.2, 1.0)), Eigen::Vector3d(5.0, -3.0, 0.3));

/// Returns the track of poses first...last - 1, displaced by relaxation.
Track track(int first, int last, const SessionId& session = "a") {
  Track made;
  made.session = session;
  for (int i = first; i < last; ++i) {
    made.stamps.push_back(i * kVoPeriod);
    made.odom.push_back(at(first).inverse() * at(i));
    made.map.push_back(kMoved * at(i) * Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.001 * i, 0.0, 0.0)));
  }
  return made;
}

void receive(MapToOdomEstimator& estimator, int first, int last, StampNs offset = 0) {
  for (int i = first; i < last; ++i) estimator.addOdometry({i * kVoPeriod + offset, at(i)});
}

void expectTied(MapToOdomEstimator& estimator, const Track& track, int newest) {
  const auto T = estimator.estimate(&track);
  ASSERT_TRUE(T);
  const auto place = static_cast<std::size_t>(newest - track.stamps.front() / kVoPeriod);
  EXPECT_TRUE(isApprox(*T * at(newest), track.map[place], 1e-9));
}

TEST(MapToOdomEstimator, IsOfTheNewestPoseWhoseOdometryIsKnown) {
  MapToOdomEstimator estimator;
  receive(estimator, 0, 50);
  expectTied(estimator, track(0, 26), 25);
  expectTied(estimator, track(0, 30), 29);
  expectTied(estimator, track(0, 30), 29);
  receive(estimator, 50, 60);
  expectTied(estimator, track(0, 58), 57);
  expectTied(estimator, track(0, 80), 59);
}

TEST(MapToOdomEstimator, IsUnknownForOdometryStartedEarlierUntilStampsMatch) {
  MapToOdomEstimator estimator;
  EXPECT_FALSE(estimator.estimate(nullptr));
  receive(estimator, 100, 130);
  EXPECT_FALSE(estimator.estimate(nullptr));
  const Track early = track(60, 100), late = track(60, 110);
  EXPECT_FALSE(estimator.estimate(&early));
  expectTied(estimator, late, 109);
}

TEST(MapToOdomEstimator, WhereOdomBeginsTheMapDoes) {
  MapToOdomEstimator estimator;
  receive(estimator, 0, 20);
  EXPECT_TRUE(isApprox(*estimator.estimate(nullptr), Pose(), 0.0));
}

TEST(MapToOdomEstimator, ANewSessionIsTiedAtItsFirstPose) {
  MapToOdomEstimator estimator;
  receive(estimator, 0, 100);
  expectTied(estimator, track(0, 76), 75);
  Track next = track(75, 77, "b");
  for (Pose& pose : next.map) pose = kMoved * kMoved * pose;
  const Track empty = track(0, 0, "b");
  EXPECT_TRUE(estimator.estimate(&empty)) << "what it was";
  expectTied(estimator, next, 76);
}

TEST(MapToOdomEstimator, ARestartedOdometryStartsAtTheNewestPose) {
  MapToOdomEstimator estimator;
  receive(estimator, 0, 40);
  const Track before = track(0, 40);
  expectTied(estimator, before, 39);
  receive(estimator, 0, 20, 41 * kVoPeriod);
  EXPECT_TRUE(isApprox(*estimator.estimate(&before), before.map.back(), 0.0));
  Track after = before;
  after.stamps.push_back(42 * kVoPeriod);
  after.map.push_back(kMoved);
  EXPECT_TRUE(isApprox(*estimator.estimate(&after) * at(1), kMoved, 1e-9));
}

TEST(MapToOdomEstimator, ARestartedRecordingIgnoresThePreviousSession) {
  MapToOdomEstimator estimator;
  receive(estimator, 0, 100);
  const Track before = track(0, 100), again = track(0, 10, "b");
  expectTied(estimator, before, 99);
  receive(estimator, 0, 30);
  EXPECT_TRUE(isApprox(*estimator.estimate(&before), Pose(), 0.0)) << "though its stamps are the same";
  expectTied(estimator, again, 9);
}

TEST(MapToOdomEstimator, ASessionOfAnEmptiedGraphMayHaveTheIdOfOneBefore) {
  MapToOdomEstimator estimator;
  receive(estimator, 0, 100);
  expectTied(estimator, track(0, 100), 99);
  receive(estimator, 0, 1);
  estimator.forgetSessions();
  EXPECT_FALSE(estimator.estimate(nullptr) && !isApprox(*estimator.estimate(nullptr), Pose(), 0.0));
  receive(estimator, 1, 30);
  expectTied(estimator, track(0, 10), 9);
}

TEST(MapToOdomEstimator, IsBounded) {
  MapToOdomEstimator estimator;
  receive(estimator, 0, 20'000);
  const Track early = track(0, 100), late = track(0, 19'000);
  EXPECT_TRUE(isApprox(*estimator.estimate(&early), early.map.back(), 0.0)) << "that long ago is forgotten";
  expectTied(estimator, late, 18'999);
}

}  // namespace
}  // namespace pose_graph
