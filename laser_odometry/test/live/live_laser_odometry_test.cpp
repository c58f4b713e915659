// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_laser_odometry.hpp"

#include <gtest/gtest.h>

#include "support/spinning_lidar.hpp"

namespace laser_odometry {
namespace {

struct RecordedPoses {
  std::vector<LaserPose> poses;
  LiveLaserOdometry odometry{Parameters(), [this](const LaserPose& pose, double process_ms) {
                               poses.push_back(pose);
                               EXPECT_GE(process_ms, 0.0);
                             }};
};

TEST(LiveLaserOdometry, EqualsTheCoreToTheLastBit) {
  const SpinningLidar lidar;
  const BoxWorld world = makeRoom();
  RecordedPoses live;
  live.odometry.place(lidar.T_base_lidar);
  LaserOdometry core({}, lidar.T_base_lidar);
  for (int i = 0; i < 4; ++i) {
    const Sweep sweep = lidar.scan(world, makeDrive(0.5, 0.1), 0.1 * i, 1);
    live.odometry.process(sweep);
    EXPECT_EQ(live.poses.back().T_odom_base.matrix(), core.process(sweep).T_odom_base.matrix());
  }
  EXPECT_FALSE(live.odometry.localMap().empty());
}

TEST(LiveLaserOdometry, TimeGoingBackOrAnotherMountingBeginsANewSession) {
  const SpinningLidar lidar;
  const BoxWorld world = makeRoom();
  RecordedPoses live;
  EXPECT_TRUE(live.odometry.report().is_warning);
  live.odometry.place(lidar.T_base_lidar);
  const auto show = [&](double time) { live.odometry.process(lidar.scan(world, makeDrive(0.5, 0.0), time, 1)); };
  show(5.0);
  show(5.1);
  show(5.05);  // late, within the session
  EXPECT_FALSE(live.poses.back().accepted);
  show(1.0);
  EXPECT_TRUE(live.poses.back().accepted);
  EXPECT_EQ(live.odometry.sessions(), 2);
  live.odometry.place(Pose(Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.0}));
  EXPECT_FALSE(live.odometry.isRunning());
  show(1.1);
  EXPECT_EQ(live.odometry.sessions(), 3);
  live.odometry.end("reset");
  EXPECT_NE(live.odometry.report().summary.find("reset"), std::string::npos);
}

TEST(LiveLaserOdometry, APlanarLaserThatIsNotHorizontalIsRefusedWithTheReason) {
  LiveLaserOdometry odometry(Parameters(), {}, Scanner::Planar);
  const Pose tilted(urban_nav_core::expSo3({0.3, 0.0, 0.0}), {0.1, 0.0, 0.2}), level;
  EXPECT_FALSE(odometry.place(std::nullopt, "base_link", "laser"));
  EXPECT_NE(odometry.report().summary.find("no transform from base_link to laser"), std::string::npos);
  EXPECT_FALSE(odometry.place(tilted, "base_link", "laser"));
  EXPECT_NE(odometry.report().summary.find("laser is tilted by 17.2 deg against base_link"), std::string::npos)
      << odometry.report().summary;
  EXPECT_FALSE(odometry.isPlaced());
  EXPECT_TRUE(odometry.place(level, "base_link", "laser"));
  EXPECT_TRUE(odometry.isPlaced());
}

}  // namespace
}  // namespace laser_odometry
