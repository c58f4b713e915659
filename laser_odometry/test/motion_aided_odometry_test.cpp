// SPDX-License-Identifier: BSD-3-Clause
#include "laser_odometry/motion_aided_odometry.hpp"

#include <gtest/gtest.h>

#include "support/drive_sensors.hpp"
#include "support/free_places.hpp"

namespace laser_odometry {
namespace {

using urban_nav_core::Health;
using urban_nav_core::MotionEstimates;

struct AidedRun : FreeRun {
  MotionEstimates motion;
};

/// A sweep before it is processed: its number, and itself.
using ChangeSweep = std::function<void(int, Sweep&)>;

AidedRun driveAided(const FreePlace& place, const SensorErrors& errors, std::uint64_t seed,
                    const ChangeSweep& change = {}) {
  Parameters parameters;
  parameters.max_range = place.max_range;
  MotionAidedOdometry odometry(parameters, place.laser.T_base_lidar, place.scanner);
  const BoxWorld world = place.world(seed);
  const std::function<Pose(double)> motion = makeMotion(place, seed);
  DriveSensors sensors(motion, errors, seed);
  AidedRun run;
  run.is_planar = place.scanner == Scanner::Planar;
  for (int i = 0; i < place.sweeps; ++i) {
    const double t = place.laser.sweep_s * i;
    Sweep sweep = place.laser.scan(world, motion, t, seed);
    if (change) change(i, sweep);
    run.poses.push_back(odometry.process(sweep, sensors.until(t + 0.5 * place.laser.sweep_s)));
    run.truth.push_back(motion(t));
    if (i > 0) run.chain.append(run.poses.back().step);
  }
  run.motion = odometry.motion();
  return run;
}

const FreePlace& aidedCorridor() {
  static const FreePlace place = makeFreePlaces()[1];
  return place;
}

FreePlace aidedTunnel() { return makeFreePlaces()[2]; }

FreePlace shortened(FreePlace place, int sweeps) {
  place.sweeps = sweeps;
  return place;
}

TEST(MotionAidedOdometry, WheelsCarryTheMotionAlongATunnel) {
  SensorErrors errors;
  errors.speed_scale = 1.02;
  errors.bias = {0.005, -0.01, 0.02};
  const FreePlace place = aidedTunnel();
  const AidedRun run = driveAided(place, errors, 1);
  EXPECT_GT(run.free(), 40);
  EXPECT_TRUE(run.motion.uses_gyroscope && run.motion.uses_wheels);
  EXPECT_TRUE(run.motion.faults.empty());
  EXPECT_LT(std::abs(run.motion.wheel_scale - errors.speed_scale), 4.0 * run.motion.wheel_scale_sigma);
  EXPECT_LT(run.motion.wheel_scale_sigma, 0.01);
  const std::size_t last = run.poses.size() - 1;
  // 63 m of tunnel: 1 % of scale. Sweeps that barely see a portal have errors beyond their covariances, with sensors as
  // without (NEES over 50 sweeps of up to 11).
  EXPECT_LT(run.error(last), 0.63);
  EXPECT_LT(run.error(last), 5.0 * run.stated());
  for (const std::size_t sweeps : {1, 10, 50}) {
    EXPECT_GT(run.nees(sweeps), 1.5) << sweeps;
    EXPECT_LT(run.nees(sweeps), sweeps < 50 ? 9.0 : 12.0) << sweeps;
  }
}

TEST(MotionAidedOdometry, ADriveThatBeginsInATunnelHasTheErrorOfUncalibratedWheels) {
  SensorErrors errors;
  errors.speed_scale = 1.04;
  FreePlace place = shortened(aidedTunnel(), 60);
  place.world = [](std::uint64_t) { return makeTunnel(); };
  const AidedRun run = driveAided(place, errors, 2);
  const std::size_t last = run.poses.size() - 1;
  EXPECT_GE(run.free(), 57);
  EXPECT_NE(run.poses.back().status.health, Health::Ok);
  EXPECT_LT(run.error(last), 0.06 * run.length());
  EXPECT_LT(run.error(last), 3.0 * run.stated());
  EXPECT_LT(run.stated(), 0.12 * run.length());  // 5 % of scale
}

TEST(MotionAidedOdometry, TheErrorAlongACorridorIsThatOfTheWheels) {
  const AidedRun run = driveAided(aidedCorridor(), {}, 1);
  const FreeRun without = driveFreePlace(aidedCorridor(), {}, 1);
  const std::size_t last = run.poses.size() - 1;
  EXPECT_GT(run.free(), 100);
  EXPECT_LT(run.error(last), 0.3);  // 1 % of 22 m
  EXPECT_LT(10.0 * run.error(last), without.error(last));
  EXPECT_LT(run.error(last), 4.0 * run.stated());
  for (const std::size_t sweeps : {1, 10, 50}) EXPECT_LT(run.nees(sweeps), 6.0) << sweeps;
}

/// Ten seconds in an office, whose walls measure the motion.
AidedRun driveOffice(const SensorErrors& errors) {
  const SpinningLidar laser = makePlanarLaser();
  const BoxWorld world = makeOffice(1);
  const std::function<Pose(double)> motion = makeFigureEight(5.0, 2.0, 30.0);
  DriveSensors sensors(motion, errors, 1);
  MotionAidedOdometry odometry({}, laser.T_base_lidar, Scanner::Planar);
  AidedRun run;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.1 * i;
    run.poses.push_back(odometry.process(laser.scan(world, motion, t, 1), sensors.until(t + 0.05)));
    run.truth.push_back(motion(t));
  }
  run.motion = odometry.motion();
  return run;
}

TEST(MotionAidedOdometry, SensorsInOrderAreCalibratedBySweeps) {
  SensorErrors errors;
  errors.speed_scale = 1.03;
  errors.bias = {0.0, 0.0, 0.02};
  const AidedRun run = driveOffice(errors);
  EXPECT_TRUE(run.motion.uses_gyroscope && run.motion.uses_wheels);
  EXPECT_TRUE(run.motion.faults.empty());
  EXPECT_LT(std::abs(run.motion.wheel_scale - errors.speed_scale), 4.0 * run.motion.wheel_scale_sigma);
  EXPECT_LT(run.motion.wheel_scale_sigma, 0.01);
  EXPECT_LT(std::abs(run.motion.gyroscope_bias.z() - 0.02), 4.0 * run.motion.gyroscope_bias_sigma.z());
  EXPECT_LT(run.motion.gyroscope_bias_sigma.z(), 0.005);
  EXPECT_LT(run.error(99), 0.01);
}

TEST(MotionAidedOdometry, AGyroscopeInDegreesIsLeftOutAndNamed) {
  SensorErrors errors;
  errors.rate_factor = 180.0 / M_PI;
  const AidedRun run = driveOffice(errors);
  EXPECT_TRUE(run.motion.gyroscope_left_out);
  EXPECT_TRUE(run.motion.uses_wheels);
  ASSERT_FALSE(run.motion.faults.empty());
  EXPECT_FALSE(run.motion.faults.front().is_wheels);
  EXPECT_NE(run.motion.faults.back().sentence.find("the sweeps"), std::string::npos)
      << run.motion.faults.back().sentence;
  EXPECT_LT(run.error(99), 0.01);
}

TEST(MotionAidedOdometry, WheelsOfAnotherRadiusAreLeftOutAndNamed) {
  SensorErrors errors;
  errors.speed_scale = 1.4;
  const AidedRun run = driveOffice(errors);
  EXPECT_TRUE(run.motion.wheels_left_out);
  EXPECT_TRUE(run.motion.uses_gyroscope);
  ASSERT_FALSE(run.motion.faults.empty());
  EXPECT_TRUE(run.motion.faults.front().is_wheels);
  EXPECT_NE(run.motion.faults.back().sentence.find("times that of the sweeps"), std::string::npos)
      << run.motion.faults.back().sentence;
  EXPECT_LT(run.error(99), 0.01);
}

TEST(MotionAidedOdometry, LostSweepsAreBridged) {
  SensorErrors errors;
  errors.bias = {0.0, 0.0, 0.02};
  // No returns for two seconds, while the speed changes.
  const AidedRun run = driveAided(shortened(aidedTunnel(), 80), errors, 1, [](int i, Sweep& sweep) {
    if (i >= 40 && i < 60) sweep.beams.clear();
  });
  EXPECT_EQ(run.poses[50].status.health, Health::Lost);
  const Pose truth = run.truth[39].inverse() * run.truth[60],
             seen = run.poses[39].T_odom_base.inverse() * run.poses[60].T_odom_base;
  EXPECT_LT(distanceBetween(truth, seen), 0.3);  // of 12 m
  EXPECT_LT(run.error(run.poses.size() - 1), 4.0 * run.stated() + 0.05);
}

// 8 m/s in a street, turning to and fro at 1.7 Hz: the rate changes within a sweep by more than its constant
// acceleration describes.
TEST(MotionAidedOdometry, QuickTurnsAreFollowedWithSensorsAsWithout) {
  SpinningLidar lidar;
  lidar.columns = 600;
  const BoxWorld world = makeStreet(1);
  constexpr double kRate = 0.5, kPulse = 2.0 * M_PI * 1.7;  // rad/s
  const auto yawAt = [](double t) { return kRate / kPulse * (1.0 - std::cos(kPulse * t)); };
  constexpr double kTick = 5e-4;  // s
  std::vector<Vector3d> path = {{0.0, 0.0, 1.7}};
  for (double t = 0.5 * kTick; path.size() < 14'000; t += kTick)
    path.push_back(path.back() + 8.0 * kTick * Vector3d(std::cos(yawAt(t)), std::sin(yawAt(t)), 0.0));
  const auto motion = [&](double t) {  // from 0.2 s before the first sweep
    const double at = (t + 0.2) / kTick;
    const auto tick = static_cast<std::size_t>(at);
    const Vector3d p = path[tick] + (at - static_cast<double>(tick)) * (path[tick + 1] - path[tick]);
    return Pose(urban_nav_core::expSo3({0.0, 0.0, yawAt(t + 0.2)}), p);
  };
  SensorErrors none, both;
  none.has_gyroscope = none.has_wheels = false;
  both.bias = {0.0, 0.01, -0.02};
  double turns[2] = {0.0, 0.0}, steps[2] = {0.0, 0.0};
  for (const int aided : {0, 1}) {
    DriveSensors sensors(motion, aided == 1 ? both : none, 1);
    MotionAidedOdometry odometry({}, lidar.T_base_lidar);
    constexpr int kSweeps = 60;
    for (int i = 0; i < kSweeps; ++i) {
      const double t = 0.1 * i;
      const LaserPose pose = odometry.process(lidar.scan(world, motion, t, 1), sensors.until(t + 0.05));
      if (i < 20) continue;  // the sensors are being calibrated
      const Pose truth = motion(t - 0.1).inverse() * motion(t);
      turns[aided] += angleBetween(truth, pose.step.T_from_to) / 40.0;
      steps[aided] += distanceBetween(truth, pose.step.T_from_to) / 40.0;
    }
  }
  EXPECT_LT(turns[1], 1.2 * turns[0]);
  EXPECT_LT(steps[1], 1.2 * steps[0]);
  EXPECT_LT(steps[1], 0.005);
}

TEST(MotionAidedOdometry, WithoutInputsThePosesAreThoseOfLaserOdometry) {
  SensorErrors none;
  none.has_gyroscope = none.has_wheels = false;
  const FreePlace place = shortened(aidedCorridor(), 60);
  const AidedRun run = driveAided(place, none, 1);
  const FreeRun expected = driveFreePlace(place, {}, 1);
  for (std::size_t i = 0; i < run.poses.size(); ++i) {
    EXPECT_EQ(run.poses[i].T_odom_base.matrix(), expected.poses[i].T_odom_base.matrix());
    EXPECT_EQ(run.poses[i].step.covariance, expected.poses[i].step.covariance);
  }
}

TEST(MotionAidedOdometry, GoesOnFromItsState) {
  const FreePlace place = shortened(aidedCorridor(), 80);
  const BoxWorld world = place.world(1);
  const std::function<Pose(double)> motion = makeMotion(place, 1);
  DriveSensors sensors(motion, {}, 1);
  Parameters parameters;
  parameters.max_range = place.max_range;
  MotionAidedOdometry one(parameters, place.laser.T_base_lidar, place.scanner);
  std::optional<MotionAidedOdometry> other;
  for (int i = 0; i < place.sweeps; ++i) {
    const double t = 0.1 * i;
    const Sweep sweep = place.laser.scan(world, motion, t, 1);
    const auto inputs = sensors.until(t + 0.05);
    if (i == 60) other.emplace(parameters, place.laser.T_base_lidar, one.state(), place.scanner);
    const LaserPose pose = one.process(sweep, inputs);
    if (!other) continue;
    const LaserPose again = other->process(sweep, inputs);
    EXPECT_EQ(pose.T_odom_base.matrix(), again.T_odom_base.matrix());
    EXPECT_EQ(pose.covariance, again.covariance);
    EXPECT_EQ(one.motion().wheel_scale, other->motion().wheel_scale);
  }
  EXPECT_EQ(one.state(), other->state());
}

}  // namespace
}  // namespace laser_odometry
