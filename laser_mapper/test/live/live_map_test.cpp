// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "support/room_rounds.hpp"
#include "support/scanned_room.hpp"
#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_mapper {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;

std::string liveMapPath() { return ::testing::TempDir() + "live_map_test.db"; }

/// Map of the room; odometry does not begin at the room's origin.
class LiveMapTest : public ::testing::Test {
 protected:
  LiveMapTest() : map_(Parameters(), liveMapPath(), 10.0) {
    map_.sensors().placeLaser("laser_left", testing_room::roomLaser());
  }

  void drive() {
    for (const auto& pose : trajectory_) map_.addOdometry({pose.stamp, T_odom_room_ * pose.pose});
    for (const auto& scan : testing_room::scansOfRoom(trajectory_, testing_room::roomLaser(), 0.005))
      map_.addScan("laser_left", scan);
  }
  static double median(const std::vector<MapPoint>& points, const Pose& T_room_map) {
    std::vector<double> distances;
    for (const MapPoint& point : points)
      distances.push_back(testing_room::distanceToRoom(T_room_map * point.p.cast<double>()));
    std::sort(distances.begin(), distances.end());
    return distances.empty() ? 1e9 : distances[distances.size() / 2];
  }

  const urban_nav_core::Trajectory trajectory_ = testing_room::driveThroughRoom(10.0);
  const Pose T_odom_room_ = Pose(Eigen::Matrix3d::Identity(), Vector3d(5.0, 1.0, 0.0));
  LiveMap map_;
};

TEST_F(LiveMapTest, WithoutAGraphItIsInTheFrameOfOdometry) {
  EXPECT_TRUE(map_.render().empty());
  drive();
  const auto points = map_.render();
  EXPECT_GT(points.size(), 1000U);
  EXPECT_LT(median(points, T_odom_room_.inverse()), 0.003);
}

TEST_F(LiveMapTest, FollowsThePosesOfTheGraphAndRendersOnlyWhatMoved) {
  drive();
  map_.render();
  urban_nav_core::GraphUpdate update;
  update.revision = 1;
  update.segments.emplace_back();
  for (std::size_t i = 0; i < trajectory_.size(); i += 10)
    update.segments.back().poses.push_back({trajectory_[i].stamp, trajectory_[i].pose});
  map_.addGraph(update);
  EXPECT_LT(median(map_.render(), Pose()), 0.003);
  EXPECT_EQ(map_.counts().chunks_rendered, map_.counts().chunks);
  map_.render();
  EXPECT_EQ(map_.counts().chunks_rendered, 0U);
  update.revision = 5;
  update.previous = 4;
  map_.addGraph(update);
  EXPECT_EQ(map_.counts().updates_missed, 1U);
}

TEST_F(LiveMapTest, PosesOfAnEarlierRoundAtTheSameTimesAreNotUsed) {
  const auto announce = [this](const std::string& id) {
    urban_nav_core::SessionStep step;
    step.from = trajectory_[0].stamp;
    step.to = trajectory_[1].stamp;
    step.session = std::make_shared<const urban_nav_core::OdometrySession>(
        urban_nav_core::OdometrySession{id, "", "", "", step.from});
    map_.addStep(step);
  };
  const auto place = [this](const std::string& session, double height) {
    urban_nav_core::GraphUpdate update;
    update.segments.emplace_back();
    update.segments.back().session = session;
    for (const auto& pose : trajectory_)
      update.segments.back().poses.push_back(
          {pose.stamp, Pose(Eigen::Matrix3d::Identity(), Vector3d(0.0, 0.0, height)) * pose.pose});
    map_.addGraph(update);
  };
  drive();
  announce("first");
  place("first", 100.0);
  drive();
  place("first", 100.0);  // a batch of the graph at the end of the round
  EXPECT_LT(median(map_.render(), T_odom_room_.inverse()), 0.003) << "no data of the second round yet";
  place("second", 0.0);
  announce("second");
  place("first", 100.0);
  EXPECT_LT(median(map_.render(), Pose()), 0.003);
}

TEST_F(LiveMapTest, ARestartedSessionDropsThePreviousOne) {
  drive();
  EXPECT_FALSE(map_.render().empty());
  map_.addOdometry({trajectory_.front().stamp - 3'000'000'000, Pose()});
  EXPECT_EQ(map_.counts().sensors.scans, 0U);
  EXPECT_TRUE(map_.render().empty());
  drive();
  EXPECT_FALSE(map_.render().empty()) << "the laser has not moved";
}

TEST_F(LiveMapTest, ScansOfALaserWithoutAPlaceAreCounted) {
  map_.addScan("laser_right", urban_nav_core::Scan());
  EXPECT_EQ(map_.counts().sensors.unplaced, 1U);
}

/// Two rounds through the room with drifting odometry; every fifth pose is in the graph.
class LiveConstraintsTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kNodeStep = 5;

  LiveConstraintsTest() : map_(Parameters(), ::testing::TempDir() + "live_constraints_test.db", 10.0) {
    map_.sensors().placeLaser("laser_right", testing_room::outwardLaser());
    std::mt19937 random(5);
    for (urban_nav_core::StampNs stamp = truth_.front().stamp; stamp < truth_.back().stamp; stamp += 40'000'000)
      map_.addScan("laser_right", testing_room::scanRoom(truth_, testing_room::outwardLaser(), stamp, 0.005, random));
  }
  void drive(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < std::min(to, truth_.size()); ++i) {
      map_.addOdometry(drifting_[i]);
      if (i < kNodeStep || i % kNodeStep != 0) continue;
      urban_nav_core::RelativePose step;
      step.from = drifting_[i - kNodeStep].stamp;
      step.to = drifting_[i].stamp;
      step.covariance = 1e-6 * urban_nav_core::Matrix6d::Identity();
      map_.addStep(step);
    }
  }
  void closeByIcp(double a, double b, urban_nav_core::ClosureVerdict verdict) {
    urban_nav_core::MetricClosure closure;
    closure.a.stamp = truth_.front().stamp + std::llround(1e9 * a);
    closure.b.stamp = truth_.front().stamp + std::llround(1e9 * b);
    closure.method = urban_nav_core::ClosureMethod::Icp;
    closure.verdict = verdict;
    closure.measured.information = 1e12 * urban_nav_core::Matrix6d::Identity();  // exceeds that of the planes
    map_.addClosure(closure);
  }
  double error(const Pose& T_a_b, const urban_nav_core::RelativeConstraint& of) const {
    const Pose T_true = truth_[truth_.nearest(of.a.stamp)].pose.inverse() * truth_[truth_.nearest(of.b.stamp)].pose;
    const urban_nav_core::Vector6d e = urban_nav_core::boxMinus(T_a_b, T_true);
    return e.dot(of.measured.information * e);
  }

  const urban_nav_core::Trajectory truth_ = testing_room::driveRounds();
  const urban_nav_core::Trajectory drifting_ = testing_room::driftFrom(truth_, 0.1);
  LiveMap map_;
};

TEST_F(LiveConstraintsTest, PlanesOfTwoPassesConstrainPosesOfTheGraphOnce) {
  drive(0, truth_.size() - 100);
  const auto first = map_.takeConstraints();
  ASSERT_GT(first.size(), 2U);
  double before = 0.0, after = 0.0;
  for (const urban_nav_core::RelativeConstraint& constraint : first) {
    EXPECT_EQ(constraint.kind, "plane");
    EXPECT_TRUE(constraint.a.session.empty() && constraint.b.session.empty());
    for (const urban_nav_core::PoseRef* ref : {&constraint.a, &constraint.b})
      EXPECT_EQ((ref->stamp - truth_.front().stamp) % (kNodeStep * 50'000'000), 0) << "a pose of the graph";
    after += error(constraint.measured.T_a_b, constraint);
    before += error(drifting_[truth_.nearest(constraint.a.stamp)].pose.inverse() *
                        drifting_[truth_.nearest(constraint.b.stamp)].pose,
                    constraint);
  }
  EXPECT_LT(after, 0.1 * before);
  EXPECT_TRUE(map_.takeConstraints().empty()) << "already returned";
  drive(truth_.size() - 100, truth_.size());
  for (const auto& constraint : map_.takeConstraints())
    EXPECT_GT(std::max(constraint.a.stamp, constraint.b.stamp), first.back().b.stamp - kPlaneGroupTime);
}

TEST_F(LiveConstraintsTest, TheInformationOfAnIcpClosureIsNotRepeated) {
  closeByIcp(20.0, 55.0, urban_nav_core::ClosureVerdict::Rejected);
  closeByIcp(-500.0, 55.0, urban_nav_core::ClosureVerdict::Accepted);  // with an earlier session
  closeByIcp(12.0, 47.0, urban_nav_core::ClosureVerdict::Accepted);
  drive(0, truth_.size());
  const auto taken = map_.takeConstraints();
  EXPECT_GT(map_.counts().constraints_shared, 0U);
  EXPECT_EQ(map_.counts().constraints, taken.size());
  // Clouds of 10 m are 6.5 s to both sides at the largest speed.
  const auto seconds = [&](const urban_nav_core::PoseRef& ref) {
    return urban_nav_core::secondsBetween(truth_.front().stamp, ref.stamp);
  };
  for (const auto& constraint : taken)
    EXPECT_FALSE(std::abs(seconds(constraint.a) - 12.0) < 6.5 && std::abs(seconds(constraint.b) - 47.0) < 6.5);
}

TEST_F(LiveConstraintsTest, WithoutPosesOfTheGraphThereAreNone) {
  for (const urban_nav_core::StampedPose& pose : drifting_) map_.addOdometry(pose);
  EXPECT_TRUE(map_.takeConstraints().empty());
}

TEST(LiveMapFile, IsRemovedWithTheMap) {
  { const LiveMap map(Parameters(), liveMapPath(), 10.0); }
  EXPECT_FALSE(std::filesystem::exists(liveMapPath()));
}

std::size_t pointsIn(const std::vector<LiveMap::ChangedTile>& tiles) {
  std::size_t all = 0;
  for (const LiveMap::ChangedTile& tile : tiles) all += tile.points.size();
  return all;
}

TEST_F(LiveMapTest, TilesAreTakenOnceUntilTheyChange) {
  drive();
  const std::size_t all = map_.render().size();
  const auto first = map_.takeChanged(1);
  ASSERT_EQ(first.size(), 1U);
  const auto rest = map_.takeChanged(1'000'000);
  EXPECT_EQ(pointsIn(first) + pointsIn(rest), all);
  EXPECT_TRUE(map_.takeChanged(1'000'000).empty());
  map_.render();
  EXPECT_TRUE(map_.takeChanged(1'000'000).empty()) << "unchanged";
  map_.repeatAll();
  EXPECT_EQ(pointsIn(map_.takeChanged(1'000'000)), all);
  map_.clear();
  const auto emptied = map_.takeChanged(1'000'000);
  EXPECT_EQ(emptied.size(), first.size() + rest.size());
  EXPECT_EQ(pointsIn(emptied), 0U);
  EXPECT_EQ(emptied.front().revision, 2);
}

TEST_F(LiveMapTest, IsSavedAsAFile) {
  drive();
  const std::string path = ::testing::TempDir() + "live_map_test.ply";
  const std::size_t points = map_.save(path);
  EXPECT_GT(points, 1000U);
  EXPECT_EQ(urban_nav_core::readCloud(path).cloud.points.size(), points);
  std::filesystem::remove(path);
  EXPECT_THROW(map_.save("/no/such/folder/map.ply"), urban_nav_core::Error);
  EXPECT_EQ(map_.measureQuality().walls().pairs, 0U) << "a single pass";
}

}  // namespace
}  // namespace laser_mapper
