// SPDX-License-Identifier: BSD-3-Clause
#include "live/cloud_proposals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "urban_nav_core/testing/scanner.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::OdometryChain;
using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::TopologicalClosure;
using urban_nav_core::testing::World;

constexpr int kOutFrames = 130;              // 26 m, as many back
constexpr double kFrameMetres = 0.2;         // m
constexpr StampNs kFrameTime = 100'000'000;  // ns
constexpr double kVoxel = 0.5;               // m
constexpr StampNs kYesterday = -86'400'000'000'000;

/// A drive through the courtyard and back.
Pose poseAtFrame(int frame) {
  const double x = kFrameMetres * (frame <= kOutFrames ? frame : 2 * kOutFrames - frame) - 13.0;
  const double heading = frame <= kOutFrames ? 0.0 : M_PI;
  return Pose(Eigen::Quaterniond(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ())),
              {x, frame <= kOutFrames ? -0.5 : 0.5, 0.0});
}
StampNs stampAtFrame(int frame) { return (frame + 1) * kFrameTime; }

OdometryChain drive(int frames, StampNs since = 0) {
  OdometryChain odometry;
  for (int i = 1; i <= frames; ++i) {
    urban_nav_core::RelativePose step;
    step.from = since + stampAtFrame(i - 1);
    step.to = since + stampAtFrame(i);
    step.T_from_to = poseAtFrame(i - 1).inverse() * poseAtFrame(i);
    step.covariance = 1e-7 * urban_nav_core::Matrix6d::Identity();
    odometry.append(step);
  }
  return odometry;
}

PointCloud cloudAt(const World& world, int frame) {
  const Pose T_base_lidar(Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.5});
  PointCloud cloud =
      urban_nav_core::testing::scan(world, poseAtFrame(frame) * T_base_lidar, {}, static_cast<std::uint64_t>(frame));
  for (Eigen::Vector3f& p : cloud.points) p += Eigen::Vector3f(0.0F, 0.0F, 1.5F);
  return cloud;
}

/// Describes all waiting places and returns the proposed closures.
std::vector<TopologicalClosure> describeAll(CloudProposals& proposals, const World& world, StampNs since = 0) {
  std::vector<TopologicalClosure> closures;
  while (const auto place = proposals.next()) {
    const int frame = static_cast<int>((place->at.stamp - since) / kFrameTime) - 1;
    for (const TopologicalClosure& closure : proposals.describe(*place, cloudAt(world, frame)))
      closures.push_back(closure);
  }
  return closures;
}

TEST(CloudProposals, ProposeThePlacesOfTheReturn) {
  const World world = urban_nav_core::testing::courtyard(4);
  CloudProposals proposals(kVoxel);
  std::vector<TopologicalClosure> closures;
  for (int frames = 10; frames <= 2 * kOutFrames; frames += 10) {  // as odometry grows
    proposals.follow("part", {}, drive(frames), false, frames == 2 * kOutFrames);
    for (const TopologicalClosure& closure : describeAll(proposals, world)) closures.push_back(closure);
  }
  int revisits = 0;
  for (const TopologicalClosure& closure : closures) {
    EXPECT_EQ(closure.a.session + closure.b.session, "");
    const int a = static_cast<int>(closure.a.stamp / kFrameTime) - 1,
              b = static_cast<int>(closure.b.stamp / kFrameTime) - 1;
    if (b < kOutFrames + 50) continue;  // nothing that was seen before is 20 m back along the path
    EXPECT_LT(distanceBetween(poseAtFrame(a), poseAtFrame(b)), 6.0) << a << " and " << b;
    ++revisits;
  }
  EXPECT_GE(revisits, 5) << "of 16 m";
}

TEST(CloudProposals, FindPlacesOfEarlierSessionsWhichProposeNothingThemselves) {
  const World world = urban_nav_core::testing::courtyard(4);
  CloudProposals proposals(kVoxel);
  proposals.follow("stored", {"yesterday", 0}, drive(2 * kOutFrames, kYesterday), true, true);
  EXPECT_TRUE(describeAll(proposals, world, kYesterday).empty());
  proposals.follow("running", {}, drive(kOutFrames / 2), false, true);
  const std::vector<TopologicalClosure> closures = describeAll(proposals, world);
  ASSERT_GE(closures.size(), 3U);
  for (const TopologicalClosure& closure : closures) {
    EXPECT_EQ(closure.a.session, "yesterday");
    EXPECT_EQ(closure.b.session, "");
  }
}

TEST(CloudProposals, PlacesOfAnEndedSessionKeepItsName) {
  const World world = urban_nav_core::testing::courtyard(4);
  CloudProposals proposals(kVoxel);
  proposals.follow("first", {}, drive(kOutFrames), false, true);
  describeAll(proposals, world);
  proposals.nameRunning("first");
  proposals.follow("second", {}, drive(kOutFrames / 2), false, true);
  for (const TopologicalClosure& closure : describeAll(proposals, world)) EXPECT_EQ(closure.a.session, "first");
}

TEST(CloudProposals, ACloudWithoutSurroundingsIsNoPlace) {
  CloudProposals proposals(kVoxel);
  proposals.follow("part", {}, drive(50), false, true);
  const auto place = proposals.next();
  ASSERT_TRUE(place);
  EXPECT_TRUE(proposals.describe(*place, {}).empty());
}

}  // namespace
}  // namespace loop_metric
