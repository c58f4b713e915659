// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "laser_odometry/laser_odometry.hpp"
#include "support/floor_plans.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_odometry {
namespace {

using urban_nav_core::Health;
using urban_nav_core::Matrix6d;

using Motion = std::function<Pose(double)>;

struct PlanarDrive {
  std::vector<LaserPose> poses;
  std::vector<Pose> truth;  // T_first_base
  urban_nav_core::OdometryChain chain;

  double endError() const { return (poses.back().T_odom_base.t() - truth.back().t()).norm(); }
  double endTurnError() const { return urban_nav_core::angleBetween(poses.back().T_odom_base, truth.back()); }
};

PlanarDrive drivePlanar(const BoxWorld& world, const SpinningLidar& laser, const Motion& motion, int scans,
                        const Parameters& parameters = {}, std::uint64_t seed = 1) {
  LaserOdometry odometry(parameters, laser.T_base_lidar, Scanner::Planar);
  PlanarDrive run;
  for (int i = 0; i < scans; ++i) {
    const double t = laser.sweep_s * i;
    run.poses.push_back(odometry.process(laser.scan(world, motion, t, seed)));
    run.truth.push_back(motion(0.0).inverse() * motion(t));
    if (i > 0) run.chain.append(run.poses.back().step);
  }
  return run;
}

bool isPositiveDefinite(const Matrix6d& covariance) {
  const auto values = urban_nav_core::symmetricEigenvalues(covariance);
  return values && (*values)[0] > 0.0;
}

Motion alongX(double speed) {
  return [speed](double t) { return Pose(Eigen::Quaterniond::Identity(), {speed * t, 0.0, 0.0}); };
}

TEST(PlanarOdometry, AnOfficeIsFollowedToMillimetres) {
  const PlanarDrive run = drivePlanar(makeOffice(1), makePlanarLaser(), makeFigureEight(5.0, 2.0, 30.0), 150);
  for (const LaserPose& pose : run.poses) {
    EXPECT_EQ(pose.status.health, Health::Ok) << pose.status;
    EXPECT_EQ(pose.status.reason, static_cast<int>(Reason::Planar));
    EXPECT_NE(pose.status.sentence.find("planar motion only"), std::string::npos) << pose.status;
    EXPECT_TRUE(pose.free_directions.empty());
  }
  EXPECT_LT(run.endError(), 0.01);
  EXPECT_LT(run.endTurnError(), 0.002);
}

TEST(PlanarOdometry, HeightRollAndPitchAreAssumedWithTheVariancesOfTheFloor) {
  Parameters parameters;
  parameters.floor_height = 0.03;
  parameters.floor_tilt = 2.0;
  const PlanarDrive run = drivePlanar(makeOffice(1), makePlanarLaser(), alongX(0.5), 41, parameters);
  const LaserPose& last = run.poses.back();  // after 2 m
  EXPECT_EQ(last.T_odom_base.t().z(), 0.0);
  EXPECT_EQ(last.T_odom_base.R()(2, 2), 1.0);
  for (const LaserPose& pose : run.poses) EXPECT_TRUE(isPositiveDefinite(pose.step.covariance));
  const auto path = run.chain.between(run.poses.front().stamp, last.stamp);
  ASSERT_TRUE(path);
  const double tilt = 2.0 * M_PI / 180.0;
  EXPECT_NEAR(std::sqrt(path->covariance(3, 3)), std::sqrt(2.0) * tilt, 0.1 * tilt);  // of both ends
  EXPECT_NEAR(std::sqrt(path->covariance(4, 4)), std::sqrt(2.0) * tilt, 0.1 * tilt);
  EXPECT_GT(std::sqrt(path->covariance(2, 2)), 0.03 * std::sqrt(2.0));
  EXPECT_LT(std::sqrt(path->covariance(2, 2)), 0.03 * std::sqrt(2.0) + 2.0 * tilt);  // and the pitch of the first pose
  EXPECT_LT(std::sqrt(path->covariance(0, 0)), 0.01);
  EXPECT_LT(std::sqrt(path->covariance(5, 5)), 0.005);
}

TEST(PlanarOdometry, ACorridorIsNamedAndDoesNotRunAway) {
  for (const double yaw : {0.0, 0.4}) {
    const Motion motion = [yaw](double t) {
      return Pose(urban_nav_core::expSo3({0.0, 0.0, yaw}), {0.8 * t, 0.0, 0.0});
    };
    const PlanarDrive run = drivePlanar(makeCorridor(), makePlanarLaser(), motion, 60);
    for (std::size_t i = 1; i < run.poses.size(); ++i) {
      const LaserPose& pose = run.poses[i];
      EXPECT_EQ(pose.status.health, Health::Degraded);
      EXPECT_EQ(pose.status.reason, static_cast<int>(Reason::FreeDirection)) << pose.status;
      EXPECT_NE(pose.status.sentence.find("planar motion only"), std::string::npos) << pose.status;
      ASSERT_EQ(pose.free_directions.size(), 1u) << i;
      const Vector3d along(std::cos(yaw), -std::sin(yaw), 0.0);  // the corridor in base_link
      EXPECT_GT(std::abs(pose.free_directions[0].head<3>().dot(along)), std::cos(5.0 * M_PI / 180.0)) << i;
      const urban_nav_core::Matrix3d C = pose.step.covariance.topLeftCorner<3, 3>();
      EXPECT_GT(along.dot(C * along), 0.01);  // m^2: unknown speed
      const Vector3d across(std::sin(yaw), std::cos(yaw), 0.0);
      EXPECT_LT(across.dot(C * across), 1e-3 * along.dot(C * along));
      EXPECT_TRUE(isPositiveDefinite(pose.step.covariance));
    }
    EXPECT_LT(run.poses.back().T_odom_base.t().norm(), 0.05) << yaw;  // no velocity was ever observed
    EXPECT_LT(run.endTurnError(), 0.005) << yaw;
  }
}

TEST(PlanarOdometry, FromARoomIntoACorridorTheLastVelocityContinuesWithGrowingVariance) {
  BoxWorld world;  // a room of 6 m, and a corridor of 1.6 m width that ends in another one
  addWall(-3.2, -3.0, -3.0, 3.0, world);
  addWall(-3.0, 3.0, 3.0, 3.2, world);
  addWall(-3.0, -3.2, 3.0, -3.0, world);
  addWall(3.0, 0.8, 33.0, 3.0, world);
  addWall(3.0, -3.0, 33.0, -0.8, world);
  addWall(33.0, 3.0, 39.0, 3.2, world);
  addWall(33.0, -3.2, 39.0, -3.0, world);
  addWall(39.0, -3.2, 39.2, 3.2, world);
  SpinningLidar laser = makePlanarLaser();
  Parameters parameters;
  parameters.max_range = 8.0;  // between x = 5 m and 31 m, 260 scans, no wall across is in range
  const PlanarDrive run = drivePlanar(world, laser, alongX(1.0), 360, parameters);
  int free = 0;
  for (std::size_t i = 0; i < run.poses.size(); ++i) {
    const LaserPose& pose = run.poses[i];
    ASSERT_NE(pose.status.health, Health::Lost) << i << " " << pose.status;
    const double error = (pose.T_odom_base.t() - run.truth[i].t()).norm();
    EXPECT_LT(error, 4.0 * std::sqrt(pose.covariance(0, 0) + pose.covariance(1, 1)) + 0.01) << i;
    EXPECT_LT(std::abs(pose.T_odom_base.t().y()), 0.03) << i;
    if (pose.free_directions.empty()) continue;
    ++free;
    EXPECT_GT(std::abs(pose.free_directions[0][0]), std::cos(5.0 * M_PI / 180.0)) << i;
  }
  EXPECT_GT(free, 240);
  EXPECT_LT(free, 280);
  EXPECT_TRUE(run.poses.back().free_directions.empty());
}

TEST(PlanarOdometry, InACorridorThePriorGivesTheMotionAlongIt) {
  const SpinningLidar laser = makePlanarLaser();
  LaserOdometry odometry({}, laser.T_base_lidar, Scanner::Planar);
  const BoxWorld world = makeCorridor();
  LaserPose pose;
  for (int i = 0; i < 12; ++i) {
    std::optional<MotionPrior> prior;
    if (i > 0) {
      prior.emplace();
      prior->step.T_from_to = Pose(urban_nav_core::expSo3({0.01, 0.01, 0.0}), {0.1, 0.004, 0.02});  // not planar
      prior->step.covariance = Matrix6d::Identity() * 1e-4;
    }
    pose = odometry.process(laser.scan(world, alongX(1.0), 0.1 * i, 1), prior);
  }
  EXPECT_NEAR(pose.T_odom_base.t().x(), 1.1, 0.005);
  EXPECT_NEAR(pose.T_odom_base.t().y(), 0.0, 0.005);  // measured, not taken from the prior
  EXPECT_EQ(pose.T_odom_base.t().z(), 0.0);
  EXPECT_NEAR(pose.step.covariance(0, 0), 1e-4, 3e-5);
}

TEST(PlanarOdometry, ARoundRoomLeavesTheYawFree) {
  SpinningLidar laser = makePlanarLaser();
  laser.T_base_lidar = Pose();
  LaserOdometry odometry({}, laser.T_base_lidar, Scanner::Planar);
  urban_nav_core::testing::Dice dice(3);
  BoxWorld anything;
  addWall(5.0, -50.0, 6.0, 50.0, anything);
  addWall(-6.0, -50.0, -5.0, 50.0, anything);
  for (int i = 0; i < 8; ++i) {
    Sweep sweep = laser.scan(anything, alongX(0.0), 0.1 * i, 1);
    for (urban_nav_core::Beam& beam : sweep.beams) beam.range = static_cast<float>(6.0 + 0.01 * dice.normal());
    const LaserPose pose = odometry.process(sweep);
    if (i == 0) continue;
    ASSERT_EQ(pose.free_directions.size(), 1u) << pose.status;
    EXPECT_NE(pose.status.sentence.find("about z"), std::string::npos) << pose.status;
  }
}

TEST(PlanarOdometry, ARobotAtRestStaysWhereItIs) {
  const PlanarDrive run = drivePlanar(makeOffice(3), makePlanarLaser(360, 0.02), alongX(0.0), 200);
  for (const LaserPose& pose : run.poses) EXPECT_LT(pose.T_odom_base.t().norm(), 0.02);
  EXPECT_LT(run.endError(), 0.01);
  EXPECT_LT(run.endTurnError(), 0.002);
}

TEST(PlanarOdometry, PeopleWalkingByDoNotMoveTheRobot) {
  const SpinningLidar laser = makePlanarLaser();
  const Motion motion = makeFigureEight(4.0, 1.5, 40.0);
  LaserOdometry alone({}, laser.T_base_lidar, Scanner::Planar), among({}, laser.T_base_lidar, Scanner::Planar);
  double without = 0.0, with = 0.0;
  int moving = 0;
  for (int i = 0; i < 120; ++i) {
    const BoxWorld world = makeOffice(5);
    BoxWorld people = world;
    for (int k = 0; k < 4; ++k) {
      const double x = -6.0 + std::fmod(3.0 * k + 0.12 * i, 12.0), y = k % 2 == 0 ? 2.8 : -2.8;
      addWall(x, y, x + 0.4, y + 0.4, people);
    }
    const Pose truth = motion(0.0).inverse() * motion(0.1 * i);
    const LaserPose a = alone.process(laser.scan(world, motion, 0.1 * i, 1));
    const LaserPose b = among.process(laser.scan(people, motion, 0.1 * i, 1));
    EXPECT_NE(b.status.health, Health::Lost) << b.status;
    without += (a.T_odom_base.t() - truth.t()).squaredNorm();
    with += (b.T_odom_base.t() - truth.t()).squaredNorm();
    moving += b.statistics.moving;
  }
  EXPECT_GT(moving, 0);
  EXPECT_LT(std::sqrt(with / 120.0), std::sqrt(without / 120.0) + 0.002);
}

TEST(PlanarOdometry, ScansWithoutReturnsAreNamedAndBridged) {
  const SpinningLidar laser = makePlanarLaser();
  const BoxWorld world = makeOffice(2);
  const Motion motion = alongX(0.5);
  LaserOdometry odometry({}, laser.T_base_lidar, Scanner::Planar);
  for (int i = 0; i < 30; ++i) {
    Sweep sweep = laser.scan(world, motion, 0.1 * i, 1);
    if (i == 12) sweep.beams.clear();
    if (i == 13)
      for (urban_nav_core::Beam& beam : sweep.beams) beam.range = std::numeric_limits<float>::quiet_NaN();
    if (i == 14) sweep.beams.resize(10);
    const LaserPose pose = odometry.process(sweep);
    ASSERT_TRUE(pose.T_odom_base.isFinite());
    ASSERT_TRUE(isPositiveDefinite(pose.step.covariance) || i == 0);
    if (i < 12 || i > 14) {
      EXPECT_NE(pose.status.health, Health::Lost) << i << " " << pose.status;
      EXPECT_NEAR(pose.T_odom_base.t().x(), 0.05 * i, 0.01) << i;
      continue;
    }
    EXPECT_EQ(pose.status.health, Health::Lost);
    EXPECT_EQ(pose.status.reason, static_cast<int>(i == 14 ? Reason::TooFewPoints : Reason::NoPoints)) << pose.status;
    EXPECT_EQ(pose.free_directions.size(), 3u);  // x, y and yaw
    EXPECT_EQ(pose.T_odom_base.t().z(), 0.0);
  }
}

TEST(PlanarOdometry, TheMountingOfTheLaserDoesNotMatter) {
  const BoxWorld world = makeOffice(4);
  const Motion motion = makeFigureEight(4.0, 1.5, 40.0);
  for (const Vector3d& turn : {Vector3d(0.0, 0.0, M_PI), Vector3d(M_PI, 0.0, 0.0), Vector3d(0.0, M_PI, 0.0),
                               Vector3d(0.0, 0.0, 2.1), Vector3d(0.03, -0.03, 0.0)}) {
    SpinningLidar laser = makePlanarLaser();
    laser.T_base_lidar = Pose(urban_nav_core::expSo3(turn), {0.15, -0.2, 0.3});
    const PlanarDrive run = drivePlanar(world, laser, motion, 80);
    EXPECT_EQ(run.poses.back().status.health, Health::Ok) << turn.transpose();
    EXPECT_LT(run.endError(), 0.01) << turn.transpose();
    EXPECT_LT(run.endTurnError(), 0.003) << turn.transpose();
  }
}

TEST(PlanarOdometry, DeskewingTakesAwayMostOfTheError) {
  SpinningLidar laser = makePlanarLaser();
  laser.sweep_s = 0.2;
  const BoxWorld world = makeOffice(6);
  const Motion motion = makeFigureEight(5.0, 2.0, 24.0);
  Parameters without;
  without.deskew = false;
  const double deskewed = drivePlanar(world, laser, motion, 60).endError();
  EXPECT_LT(deskewed, 0.01);
  EXPECT_LT(3.0 * deskewed, drivePlanar(world, laser, motion, 60, without).endError());
}

TEST(PlanarOdometry, ScansWithoutTimesHaveTheErrorOfTheirSkewInTheCovariance) {
  const SpinningLidar laser = makePlanarLaser();
  const BoxWorld world = makeOffice(7);
  const Motion motion = alongX(1.0);
  LaserOdometry timed({}, laser.T_base_lidar, Scanner::Planar), untimed({}, laser.T_base_lidar, Scanner::Planar);
  LaserPose a, b;
  for (int i = 0; i < 20; ++i) {
    Sweep sweep = laser.scan(world, motion, 0.1 * i, 1);
    a = timed.process(sweep);
    sweep.times = Sweep::Times::Unknown;
    for (urban_nav_core::Beam& beam : sweep.beams) beam.stamp = sweep.reference;
    b = untimed.process(sweep);
  }
  EXPECT_FALSE(b.statistics.deskewed);
  const double skew = 1.0 * 0.1 / std::sqrt(12.0);
  EXPECT_GT(b.step.covariance(0, 0), a.step.covariance(0, 0) + skew * skew);
}

TEST(PlanarOdometry, ARobotThatTurnsOnTheSpotIsFollowed) {
  for (const double period : {0.1, 0.2}) {
    SpinningLidar laser = makePlanarLaser(360, 0.02);
    laser.sweep_s = period;
    const Motion motion = [](double t) {  // from rest to 1.5 rad/s within a second, and back
      const double u = std::min(t, 4.0);
      return Pose(urban_nav_core::expSo3({0.0, 0.0, 1.5 * (u - 4.0 / (2.0 * M_PI) * std::sin(M_PI * u / 2.0))}),
                  Vector3d::Zero());
    };
    const PlanarDrive run = drivePlanar(makeOffice(8), laser, motion, static_cast<int>(6.0 / period));
    for (const LaserPose& pose : run.poses) EXPECT_NE(pose.status.health, Health::Lost) << pose.status;
    EXPECT_LT(run.endError(), 0.02) << period;
    EXPECT_LT(run.endTurnError(), 0.004) << period;
  }
}

TEST(PlanarOdometry, ErrorsAgreeWithTheirCovariances) {
  for (const std::uint64_t seed : {11, 12}) {
    const Motion motion = makeFigureEight(5.0, 2.0, 30.0);
    const PlanarDrive run = drivePlanar(makeOffice(seed), makePlanarLaser(360, 0.02), motion, 120, {}, seed);
    for (const std::size_t scans : {1, 10, 50}) {
      double sum = 0.0, count = 0.0;
      for (std::size_t i = 0; i + scans < run.poses.size(); ++i, count += 1.0) {
        const auto path = run.chain.between(run.poses[i].stamp, run.poses[i + scans].stamp);
        const Vector6d d = urban_nav_core::boxMinus(run.truth[i].inverse() * run.truth[i + scans], path->pose);
        const std::array<int, 3> in_plane = {0, 1, 5};
        Eigen::Matrix3d C;
        Vector3d e;
        for (std::size_t r = 0; r < 3; ++r) {
          e[static_cast<int>(r)] = d[in_plane[r]];
          for (std::size_t c = 0; c < 3; ++c)
            C(static_cast<int>(r), static_cast<int>(c)) = path->covariance(in_plane[r], in_plane[c]);
        }
        sum += e.dot(urban_nav_core::SmallCholesky<3>(C).solve(e));
      }
      EXPECT_GT(sum / count, 0.75) << seed << " " << scans;  // 3 expected
      EXPECT_LT(sum / count, 9.0) << seed << " " << scans;
    }
  }
}

TEST(PlanarOdometry, AStateContinuesToTheBitAndBelongsToItsScanner) {
  const SpinningLidar laser = makePlanarLaser(360);
  const BoxWorld world = makeOffice(9);
  const Motion motion = alongX(0.6);
  for (const int cut : {1, 2, 6}) {
    LaserOdometry whole({}, laser.T_base_lidar, Scanner::Planar), first({}, laser.T_base_lidar, Scanner::Planar);
    for (int i = 0; i < cut; ++i) {
      whole.process(laser.scan(world, motion, 0.1 * i, 1));
      first.process(laser.scan(world, motion, 0.1 * i, 1));
    }
    LaserOdometry second({}, laser.T_base_lidar, first.state(), Scanner::Planar);
    for (int i = cut; i < cut + 3; ++i) {
      const LaserPose a = whole.process(laser.scan(world, motion, 0.1 * i, 1));
      const LaserPose b = second.process(laser.scan(world, motion, 0.1 * i, 1));
      EXPECT_EQ(a.T_odom_base.matrix(), b.T_odom_base.matrix());
      EXPECT_EQ(a.step.covariance, b.step.covariance);
    }
    EXPECT_EQ(whole.state(), second.state());
    EXPECT_THROW(LaserOdometry({}, laser.T_base_lidar, first.state()), urban_nav_core::UserError);
  }
}

TEST(PlanarOdometry, TheLocalMapLiesAtTheHeightOfTheLaser) {
  const SpinningLidar laser = makePlanarLaser();
  LaserOdometry odometry({}, laser.T_base_lidar, Scanner::Planar);
  for (int i = 0; i < 5; ++i) odometry.process(laser.scan(makeOffice(1), alongX(0.5), 0.1 * i, 1));
  const std::vector<MapPoint> points = odometry.localMap();
  ASSERT_GT(points.size(), 50u);
  for (const MapPoint& point : points) {
    EXPECT_NEAR(point.p_odom.z(), 0.3, 1e-6);
    EXPECT_EQ(point.normal.z(), 0.0F);
  }
}

}  // namespace
}  // namespace laser_odometry
