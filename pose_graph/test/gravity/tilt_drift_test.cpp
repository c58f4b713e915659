// SPDX-License-Identifier: BSD-3-Clause
#include "gravity/tilt_drift.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../support/specific_force_drive.hpp"

namespace pose_graph {
namespace {

using Eigen::Vector3d;
using testing::Drive;
using testing::kStep;
using testing::kStepNs;
using urban_nav_core::expSo3;
using urban_nav_core::logSo3;
using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_core::testing::Dice;

constexpr double kMilli = 1e-3;

/// Odometry with rotation drift about all axes.
struct Odometry {
  Trajectory trajectory;
  std::vector<double> variance;  ///< true variance, rad2
};

Odometry drifting(const Drive& drive, double rad_per_root_second, Dice& dice) {
  Odometry made;
  const Trajectory truth = drive.trajectory();
  Vector3d drift = Vector3d::Zero();
  Pose pose;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i > 0) {
      const Vector3d before = drift;
      drift += rad_per_root_second * std::sqrt(kStep) * dice.normals<3>();
      const Pose step = truth[i - 1].pose.inverse() * truth[i].pose;
      pose = Pose(expSo3(drift) * truth[i].pose.q(), pose.t() + expSo3(before) * (truth[i - 1].pose.q() * step.t()));
    }
    made.trajectory.append(truth[i].stamp, pose);
    made.variance.push_back(rad_per_root_second * rad_per_root_second * kStep * static_cast<double>(i));
  }
  return made;
}

struct Lost {
  double before = 0.0, after = 0.0;  ///< rad, root mean square, perpendicular to gravity
};

/// Returns the error of the robot's tilt, before and after the correction.
Lost measureLoss(const Drive& drive, const Odometry& odometry, const std::vector<Tilt>& tilts) {
  const Trajectory truth = drive.trajectory();
  const Vector3d up = drive.trueUp();
  Lost lost;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Pose& seen = odometry.trajectory[i].pose;
    const auto across = [&](const Eigen::Quaterniond& q) {
      const Vector3d turn = logSo3(truth[i].pose.q() * q.inverse());
      return (turn - turn.dot(up) * up).squaredNorm();
    };
    lost.before += across(seen.q());
    lost.after += across(expSo3(tiltAt(tilts, truth.front().stamp, truth[i].stamp)) * seen.q());
  }
  const double count = static_cast<double>(truth.size());
  return {std::sqrt(lost.before / count), std::sqrt(lost.after / count)};
}

Drive noisyDrive(double noise) {
  Drive drive;
  drive.frames = 6000;
  drive.noise = noise;
  drive.fault = {0.1, -0.15, 0.05};
  return drive;
}

TEST(TiltDrift, IsEstimatedToTheAccuracyOfTheForces) {
  double before = 0.0, after = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Dice dice(seed);
    const Drive drive = noisyDrive(0.02);
    const Odometry odometry = drifting(drive, 3e-4, dice);
    const Lost lost =
        measureLoss(drive, odometry, tiltDrift(odometry.trajectory, odometry.variance, drive.forces(dice)));
    before += 0.1 * lost.before * lost.before;
    after += 0.1 * lost.after * lost.after;
  }
  EXPECT_GT(std::sqrt(before), 4.0 * kMilli);
  EXPECT_LT(std::sqrt(after), 1.0 * kMilli)
      << "the forces of a span are good to 0.3, the fault among them is not known";
}

TEST(TiltDrift, RescalesOverconfidentOdometry) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Dice dice(seed);
    const Drive drive = noisyDrive(0.02);
    Odometry odometry = drifting(drive, 3e-4, dice);
    const std::vector<SpecificForce> forces = drive.forces(dice);
    const Lost honest = measureLoss(drive, odometry, tiltDrift(odometry.trajectory, odometry.variance, forces));
    for (double& variance : odometry.variance) variance /= 100.0;
    const Lost overconfident = measureLoss(drive, odometry, tiltDrift(odometry.trajectory, odometry.variance, forces));
    EXPECT_LT(overconfident.after, 1.3 * honest.after) << seed;
  }
}

TEST(TiltDrift, LeavesGoodOdometryAlone) {
  Dice dice(1);
  const Drive drive = noisyDrive(0.3);
  const Odometry odometry = drifting(drive, 2e-5, dice);
  const Lost lost = measureLoss(drive, odometry, tiltDrift(odometry.trajectory, odometry.variance, drive.forces(dice)));
  EXPECT_LT(lost.after, 0.8 * kMilli) << "a force of a span is good to 3 mrad at best";
}

TEST(TiltDrift, FindsTheLeverArmOfAnAccelerometerThatIsNotAtBaseLink) {
  Dice dice(2);
  const Drive drive = noisyDrive(0.005);
  const Odometry odometry = drifting(drive, 3e-4, dice);
  std::vector<SpecificForce> near = drive.forces(dice), far = near;
  const Vector3d arm(0.2, -0.1, 0.8);
  constexpr double kH = 1e-3;
  for (SpecificForce& sample : far) {
    const double t = 1e-9 * static_cast<double>(sample.stamp);
    const Eigen::Matrix3d R = drive.rotation(t);
    sample.force += R.transpose() * ((drive.rotation(t + kH) - 2.0 * R + drive.rotation(t - kH)) / (kH * kH) * arm);
  }
  const auto lost = [&](const std::vector<SpecificForce>& forces) {
    return measureLoss(drive, odometry, tiltDrift(odometry.trajectory, odometry.variance, forces)).after;
  };
  EXPECT_LT(lost(far), 1.2 * lost(near));
}

TEST(TiltDrift, ToleratesADriftingBias) {
  Dice dice(4);
  const Drive drive = noisyDrive(0.02);
  const Odometry odometry = drifting(drive, 3e-4, dice);
  std::vector<SpecificForce> forces = drive.forces(dice);
  for (std::size_t i = 0; i < forces.size(); ++i)
    forces[i].force +=
        0.02 * Vector3d(std::sin(2e-3 * static_cast<double>(i)), std::cos(1e-3 * static_cast<double>(i)), 0.0);
  const Lost lost = measureLoss(drive, odometry, tiltDrift(odometry.trajectory, odometry.variance, forces));
  EXPECT_LT(lost.after, 1.2 * kMilli) << "of which the fault alone would be 2";
}

TEST(TiltDrift, ToleratesShocks) {
  Dice dice(3);
  const Drive drive = noisyDrive(0.02);
  const Odometry odometry = drifting(drive, 3e-4, dice);
  std::vector<SpecificForce> forces = drive.forces(dice);
  for (SpecificForce& sample : forces)
    if (dice.chance(0.002)) sample.force += 30.0 * dice.normals<3>();
  const Lost lost = measureLoss(drive, odometry, tiltDrift(odometry.trajectory, odometry.variance, forces));
  EXPECT_LT(lost.after, 1.0 * kMilli);
}

TEST(TiltDrift, IsEmptyWithoutGravity) {
  Dice dice(1);
  Drive drive = noisyDrive(0.02);
  const Odometry odometry = drifting(drive, 3e-4, dice);
  std::vector<SpecificForce> forces = drive.forces(dice);
  EXPECT_TRUE(tiltDrift(odometry.trajectory, odometry.variance, {}).empty());
  EXPECT_TRUE(tiltDrift(odometry.trajectory, odometry.variance, {forces.begin(), forces.begin() + 100}).empty())
      << "5 s";
  for (SpecificForce& sample : forces) sample.force /= 9.81;
  EXPECT_TRUE(tiltDrift(odometry.trajectory, odometry.variance, forces).empty()) << "in other units";
}

TEST(TiltAt, IsStraightBetweenAndSteadyAfter) {
  const std::vector<Tilt> tilts = {{10, Vector3d(1, 0, 0)}, {20, Vector3d(3, 0, 0)}};
  EXPECT_EQ(tiltAt(tilts, 0, 0).x(), 0.0);
  EXPECT_EQ(tiltAt(tilts, 0, 5).x(), 0.5);
  EXPECT_EQ(tiltAt(tilts, 0, 15).x(), 2.0);
  EXPECT_EQ(tiltAt(tilts, 0, 20).x(), 3.0);
  EXPECT_EQ(tiltAt(tilts, 0, 99).x(), 3.0);
  EXPECT_EQ(tiltAt({}, 0, 99).x(), 0.0);
}

}  // namespace
}  // namespace pose_graph
