// SPDX-License-Identifier: BSD-3-Clause
#include "laser_odometry/laser_odometry.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/spinning_lidar.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/trajectory/nees.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_odometry {
namespace {

using urban_nav_core::Health;
using urban_nav_core::Matrix6d;

struct Driven {
  std::vector<LaserPose> poses;
  std::vector<Pose> truth;  // T_first_base

  double endError() const { return (poses.back().T_odom_base.t() - truth.back().t()).norm(); }
};

Driven drive(const BoxWorld& world, const SpinningLidar& lidar, const std::function<Pose(double)>& motion, int sweeps,
             const Parameters& parameters = {}) {
  LaserOdometry odometry(parameters, lidar.T_base_lidar);
  Driven run;
  for (int i = 0; i < sweeps; ++i) {
    run.poses.push_back(odometry.process(lidar.scan(world, motion, 0.1 * i, 1)));
    run.truth.push_back(motion(0.0).inverse() * motion(0.1 * i));
  }
  return run;
}

bool isProper(const Matrix6d& covariance) {
  const auto values = urban_nav_core::symmetricEigenvalues(covariance);
  return values && (*values)[0] > 0.0;
}

TEST(LaserOdometry, AStreetIsFollowedToMillimetres) {
  SpinningLidar lidar;
  lidar.T_base_lidar = Pose(urban_nav_core::expSo3({0.0, 0.05, 0.3}), {0.4, 0.1, 0.3});
  const Driven run = drive(makeStreet(3), lidar, makeDrive(8.0, 0.1), 20);
  for (const LaserPose& pose : run.poses) EXPECT_EQ(pose.status.health, Health::Ok) << pose.status;
  EXPECT_LT(run.endError(), 0.02);
  EXPECT_LT(urban_nav_core::angleBetween(run.poses.back().T_odom_base, run.truth.back()), 0.001);
}

TEST(LaserOdometry, DeskewingTakesAwayMostOfTheError) {
  const SpinningLidar lidar;
  Parameters without;
  without.deskew = false;
  const auto motion = makeDrive(8.0, 0.4);
  const BoxWorld world = makeStreet(4);
  const double with_it = drive(world, lidar, motion, 15).endError();
  EXPECT_LT(5.0 * with_it, drive(world, lidar, motion, 15, without).endError());
}

TEST(LaserOdometry, AVehicleThatSwaysWithinSweepsIsFollowed) {
  SpinningLidar lidar;
  lidar.rings = 32;
  const Driven run = drive(makeStreet(7), lidar, makeSwayingDrive(3.0, 0.003, 3.0), 25);
  double sum = 0.0;
  for (std::size_t i = 2; i < run.poses.size(); ++i) {
    const Pose truth = run.truth[i - 1].inverse() * run.truth[i];
    sum += std::pow(urban_nav_core::angleBetween(run.poses[i].step.T_from_to, truth), 2);
  }
  EXPECT_LT(std::sqrt(sum / 23.0), 4e-4);  // the sway moves by 4e-3 from sweep to sweep
  EXPECT_LT(run.endError(), 0.02);
}

TEST(LaserOdometry, AVehicleThatBeginsToTurnInTheFirstSweepIsFollowed) {
  SpinningLidar lidar;
  lidar.rings = 32;
  const auto motion = [](double t) {  // 3 rad/s^2 from the begin of the first sweep
    return Pose(urban_nav_core::expSo3({0.0, 0.0, 1.5 * std::pow(t + 0.05, 2)}), Vector3d::Zero());
  };
  for (const std::uint64_t world : {3, 7}) {
    const Driven run = drive(makeStreet(world), lidar, motion, 4);
    for (std::size_t i = 1; i < run.poses.size(); ++i) {
      EXPECT_LT((run.poses[i].T_odom_base.t() - run.truth[i].t()).norm(), 0.01) << world << " " << i;
      EXPECT_LT(urban_nav_core::angleBetween(run.poses[i].T_odom_base, run.truth[i]), 1e-3) << world << " " << i;
    }
  }
}

TEST(LaserOdometry, ATunnelIsNamedAndDoesNotRunAway) {
  const Driven run = drive(makeTunnel(), SpinningLidar(), makeDrive(5.0, 0.0), 12);
  for (std::size_t i = 1; i < run.poses.size(); ++i) {
    const LaserPose& pose = run.poses[i];
    EXPECT_EQ(pose.status.health, Health::Degraded);
    EXPECT_EQ(pose.status.reason, static_cast<int>(Reason::FreeDirection));
    EXPECT_NE(pose.status.sentence.find("along x"), std::string::npos) << pose.status;
    ASSERT_EQ(pose.free_directions.size(), 1u);
    const Vector3d along = pose.free_directions[0].head<3>().normalized();
    EXPECT_GT(std::abs(along.x()), std::cos(5.0 * M_PI / 180.0)) << pose.free_directions[0].transpose();
    EXPECT_GT(pose.step.covariance(0, 0), 0.01);  // m^2: unknown speed
    EXPECT_LT(pose.step.covariance(1, 1), 1e-4);
    EXPECT_TRUE(isProper(pose.step.covariance));
  }
  EXPECT_LT(run.poses.back().T_odom_base.t().norm(), 0.05);  // no velocity was ever observed
}

TEST(LaserOdometry, InATunnelThePriorGivesTheMotionAlongIt) {
  const SpinningLidar lidar;
  const auto motion = makeDrive(5.0, 0.0);
  LaserOdometry odometry({}, lidar.T_base_lidar);
  const BoxWorld world = makeTunnel();
  LaserPose pose;
  for (int i = 0; i < 10; ++i) {
    std::optional<MotionPrior> prior;
    if (i > 0) {
      prior.emplace();
      prior->step.T_from_to = Pose(Eigen::Quaterniond::Identity(), {0.5, 0.01, 0.01});
      prior->step.covariance = Matrix6d::Identity() * 1e-4;
    }
    pose = odometry.process(lidar.scan(world, motion, 0.1 * i, 1), prior);
  }
  EXPECT_NEAR(pose.T_odom_base.t().x(), 4.5, 0.01);
  EXPECT_NEAR(pose.T_odom_base.t().y(), 0.0, 0.005);  // measured, not taken from the prior
  EXPECT_NEAR(pose.step.covariance(0, 0), 1e-4, 2e-5);
}

TEST(LaserOdometry, AFieldLeavesThreeDirectionsFree) {
  const Driven run = drive(makeField(), SpinningLidar(), makeDrive(3.0, 0.0), 6);
  for (std::size_t i = 1; i < run.poses.size(); ++i) {
    EXPECT_EQ(run.poses[i].free_directions.size(), 3u);
    EXPECT_NE(run.poses[i].status.health, Health::Ok);
  }
}

TEST(LaserOdometry, ARoomHasNoFreeDirection) {
  SpinningLidar lidar;
  lidar.rings = 64;
  const Driven run = drive(makeRoom(), lidar, makeDrive(0.5, 0.5), 12);
  for (const LaserPose& pose : run.poses) EXPECT_TRUE(pose.free_directions.empty()) << pose.status;
  const double sigma = std::sqrt(run.poses.back().covariance.topLeftCorner<3, 3>().trace());
  EXPECT_LT(sigma, 0.008);
  EXPECT_LT(run.endError(), 2.0 * sigma);
}

TEST(LaserOdometry, ErrorsOfStepsAgreeWithTheirCovariances) {
  SpinningLidar lidar;  // with the errors that the lower bounds of the covariance represent
  lidar.ring_range_sigma_m = 0.01;
  lidar.ring_angle_sigma = 0.02 * M_PI / 180.0;
  const Driven run = drive(makeRoom(), lidar, makeDrive(0.5, 0.5), 25);
  double sum = 0.0;
  for (std::size_t i = 1; i < run.poses.size(); ++i) {
    const auto& step = run.poses[i].step;
    const Pose truth = run.truth[i - 1].inverse() * run.truth[i];
    sum +=
        urban_nav_core::nees(truth, urban_nav_core::PoseWithCovariance{step.T_from_to, step.covariance}).value_or(1e9);
  }
  const double mean = sum / static_cast<double>(run.poses.size() - 1);
  EXPECT_GT(mean, 1.5);
  EXPECT_LT(mean, 12.0);
}

TEST(LaserOdometry, AStateContinuesToTheBit) {
  const SpinningLidar lidar;
  const BoxWorld world = makeStreet(6);
  const auto motion = makeDrive(7.0, 0.2);
  for (const int cut : {0, 1, 2, 5}) {
    LaserOdometry whole({}, lidar.T_base_lidar), first({}, lidar.T_base_lidar);
    for (int i = 0; i < cut; ++i) {
      whole.process(lidar.scan(world, motion, 0.1 * i, 1));
      first.process(lidar.scan(world, motion, 0.1 * i, 1));
    }
    LaserOdometry second({}, lidar.T_base_lidar, first.state());
    EXPECT_EQ(second.state(), first.state());
    for (int i = cut; i < cut + 3; ++i) {
      const LaserPose a = whole.process(lidar.scan(world, motion, 0.1 * i, 1));
      const LaserPose b = second.process(lidar.scan(world, motion, 0.1 * i, 1));
      EXPECT_EQ(a.T_odom_base.matrix(), b.T_odom_base.matrix());
      EXPECT_EQ(a.step.covariance, b.step.covariance);
    }
    EXPECT_EQ(whole.state(), second.state());
  }
}

TEST(LaserOdometry, DamagedAndForeignStatesAreRefused) {
  const SpinningLidar lidar;
  LaserOdometry odometry({}, lidar.T_base_lidar);
  odometry.process(lidar.scan(makeRoom(), makeDrive(0, 0), 0.0, 1));
  const std::string state = odometry.state();
  for (std::size_t cut = 0; cut < state.size(); cut += state.size() / 40 + 1)
    EXPECT_THROW(LaserOdometry({}, lidar.T_base_lidar, state.substr(0, cut)), urban_nav_core::Error);
  EXPECT_THROW(LaserOdometry({}, Pose(Eigen::Quaterniond::Identity(), {1, 0, 0}), state), urban_nav_core::UserError);
  Parameters other;
  other.cell = 0.4;
  EXPECT_THROW(LaserOdometry(other, lidar.T_base_lidar, state), urban_nav_core::UserError);
}

}  // namespace
}  // namespace laser_odometry
