// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/fusion/fuse_odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"

namespace {

using namespace urban_nav_core;

constexpr double kMotionRate = 0.35;  // rad/s, of the bends

/// Drives on a winding road and over humps at 4 m/s.
Pose truthAt(StampNs stamp) {
  const double s = 1e-9 * static_cast<double>(stamp);
  const Vector3d place(4.0 * s, 6.0 * std::sin(kMotionRate * s), 0.3 * std::sin(0.5 * s));
  const double heading = std::atan2(6.0 * kMotionRate * std::cos(kMotionRate * s), 4.0);
  return Pose(expSo3(Vector3d(0.0, 0.0, heading)) * expSo3(Vector3d(0.03 * std::sin(s), 0.04 * std::cos(0.7 * s), 0.0)),
              place);
}

/// Errors of the two odometries.
struct Errors {
  Vector3d mounting = Vector3d::Zero();                              // rad, true rotation over the one that was used
  double scale = 0.0;                                                // true length over stereo's, minus 1
  double stereo_drift = 1e-3, laser_drift = 2e-4, laser_end = 1e-3;  // m; rotations are a tenth of it, in rad
};

const Vector3d kLidar(0.8, 0.1, 1.6);  // in base_link

Vector6d noise(urban_nav_core::testing::Dice& dice, double sigma) {
  Vector6d tangent;
  for (int i = 0; i < 6; ++i) tangent[i] = (i < 3 ? 1.0 : 0.1) * sigma * dice.normal();
  return tangent;
}

Matrix6d isotropicCovariance(double sigma) {
  Vector6d variances;
  variances << Vector3d::Constant(sigma * sigma), Vector3d::Constant(0.01 * sigma * sigma);
  return variances.asDiagonal();
}

std::vector<RelativePose> stereoChain(int frames, StampNs period, const Errors& errors,
                                      urban_nav_core::testing::Dice& dice) {
  std::vector<RelativePose> steps;
  for (int i = 0; i < frames; ++i) {
    RelativePose step;
    step.from = i * period;
    step.to = step.from + period;
    Pose motion = truthAt(step.from).inverse() * truthAt(step.to);
    motion = Pose(motion.q(), motion.t() / (1.0 + errors.scale));
    step.T_from_to = boxPlus(motion, noise(dice, errors.stereo_drift));
    step.covariance = step.drift_covariance = isotropicCovariance(errors.stereo_drift);
    Vector6d along = Vector6d::Zero();
    along.head<3>() = step.T_from_to.t();
    step.constants.push_back({"scale", 0.0, 0.0, 5e-4, along});
    steps.push_back(step);
  }
  return steps;
}

std::vector<RelativePose> laserChain(int sweeps, StampNs period, StampNs begin, const Errors& errors,
                                     urban_nav_core::testing::Dice& dice) {
  const Pose wrong(expSo3(-errors.mounting), kLidar - expSo3(-errors.mounting) * kLidar);
  std::vector<RelativePose> steps;
  Vector6d end = noise(dice, errors.laser_end);
  for (int i = 0; i < sweeps; ++i) {
    RelativePose step;
    step.from = begin + i * period;
    step.to = step.from + period;
    const Vector6d next = noise(dice, errors.laser_end);
    const Pose motion = truthAt(step.from).inverse() * truthAt(step.to);
    step.T_from_to = wrong * boxPlus(motion, noise(dice, errors.laser_drift) + next - end) * wrong.inverse();
    end = next;
    step.drift_covariance = isotropicCovariance(errors.laser_drift);
    step.covariance = step.drift_covariance + 2.0 * isotropicCovariance(errors.laser_end);
    steps.push_back(step);
  }
  return steps;
}

double endError(const std::vector<RelativePose>& steps) {
  Pose pose;
  for (const RelativePose& step : steps) pose = pose * step.T_from_to;
  return distanceBetween(pose, truthAt(steps.front().from).inverse() * truthAt(steps.back().to));
}

const SharedConstant& constant(const FusedOdometry& fused, const std::string& name) {
  for (const SharedConstant& each : fused.shared)
    if (each.name == name) return each;
  ADD_FAILURE() << name << " is not among the shared constants";
  return fused.shared.front();
}

/// Mean squared Mahalanobis distance of the path from the first frame to frames 20 apart.
double pathNees(const std::vector<RelativePose>& steps) {
  OdometryChain chain;
  for (const RelativePose& step : steps) EXPECT_TRUE(chain.append(step));
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 20; i < steps.size(); i += 20, ++count) {
    const PoseWithCovariance path = *chain.between(steps.front().from, steps[i].to);
    Matrix6d covariance = path.covariance;
    Eigen::MatrixXd common = Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(steps.front().constants.size()));
    Pose T_first_begin;
    for (std::size_t k = 0; k <= i; ++k) {
      const Matrix6d J = boxFromLeft(path.pose) * adjoint(T_first_begin) * leftFromBox(steps[k].T_from_to);
      for (Eigen::Index c = 0; c < common.cols(); ++c)
        common.col(c) += J * steps[k].constants[static_cast<std::size_t>(c)].sensitivity;
      T_first_begin = T_first_begin * steps[k].T_from_to;
    }
    covariance += common * common.transpose();
    const Vector6d error = boxMinus(path.pose, truthAt(steps.front().from).inverse() * truthAt(steps[i].to));
    sum += error.dot(SmallCholesky<6>(covariance).solve(error));
  }
  return sum / count;
}

TEST(FuseOdometry, FindsScaleAndMountingWithinTheirStatedErrors) {
  double squares = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    urban_nav_core::testing::Dice dice(seed);
    Errors errors;
    errors.mounting = Vector3d(0.01, -0.015, 0.012);
    errors.scale = -0.006;
    const auto stereo = stereoChain(600, 100'000'000, errors, dice);
    const auto laser = laserChain(600, 100'000'000, 0, errors, dice);
    const FusedOdometry fused = fuseOdometry(stereo, laser, kLidar);
    const SharedConstant& scale = constant(fused, "scale");
    EXPECT_NEAR(scale.value, errors.scale, 4.0 * scale.sigma);
    EXPECT_LT(scale.sigma, 2e-4);
    squares += std::pow((scale.value - errors.scale) / scale.sigma, 2);
    ++count;
    for (int axis = 0; axis < 3; ++axis) {
      const SharedConstant& turn = constant(fused, std::string("mounting_") + "xyz"[axis]);
      EXPECT_NEAR(turn.value, errors.mounting[axis], 4.0 * turn.sigma);
      EXPECT_LT(turn.sigma, 1e-3);
      squares += std::pow((turn.value - errors.mounting[axis]) / turn.sigma, 2);
      ++count;
    }
    EXPECT_TRUE(fused.conflicts.empty());
  }
  EXPECT_NEAR(squares / count, 1.0, 0.45) << "80 squared errors, four deviations of their mean";
}

TEST(FuseOdometry, IsBetterThanEitherAndItsCovarianceHolds) {
  double fused_error = 0.0, laser_error = 0.0, stereo_error = 0.0, nees = 0.0;
  constexpr int kDrives = 20;
  for (unsigned seed = 1; seed <= kDrives; ++seed) {
    urban_nav_core::testing::Dice dice(seed);
    Errors errors;
    errors.scale = 0.004;
    errors.laser_drift = errors.stereo_drift = 8e-4;
    const auto stereo = stereoChain(400, 100'000'000, errors, dice);
    const auto laser = laserChain(400, 100'000'000, 0, errors, dice);
    const FusedOdometry fused = fuseOdometry(stereo, laser, kLidar);
    fused_error += endError(fused.steps);
    stereo_error += endError(stereo);
    laser_error += endError(laser);
    nees += pathNees(fused.steps) / kDrives;
  }
  EXPECT_LT(fused_error, 0.85 * laser_error);
  EXPECT_LT(fused_error, 0.85 * stereo_error);
  EXPECT_GT(nees, 3.0);
  EXPECT_LT(nees, 9.0);
}

TEST(FuseOdometry, OtherRatesAndOffsetsAreInterpolated) {
  urban_nav_core::testing::Dice dice(3);
  const auto stereo = stereoChain(700, 50'000'000, {}, dice);
  const auto laser = laserChain(380, 100'000'000, -20'000'000, {}, dice);
  const FusedOdometry fused = fuseOdometry(stereo, laser, kLidar);
  ASSERT_EQ(fused.steps.size(), stereo.size());
  for (std::size_t i = 0; i < fused.steps.size(); ++i) {
    EXPECT_EQ(fused.sources[i], StepSource::Both) << i;
    EXPECT_EQ(fused.steps[i].from, stereo[i].from);
    EXPECT_TRUE(SmallCholesky<6>(fused.steps[i].covariance).succeeded()) << i;
  }
  EXPECT_LT(endError(fused.steps), 0.5 * endError(stereo));
}

TEST(FuseOdometry, EachCarriesOnWithoutTheOther) {
  urban_nav_core::testing::Dice dice(4);
  auto stereo = stereoChain(300, 100'000'000, {}, dice);
  auto laser = laserChain(300, 100'000'000, 0, {}, dice);
  for (std::size_t i = 100; i < 150; ++i) {  // a covered camera
    stereo[i].status = {Health::Lost, 3, "no features"};
    stereo[i].T_from_to = stereo[100].T_from_to;
    stereo[i].covariance = stereo[i].drift_covariance = isotropicCovariance(0.05);
  }
  for (std::size_t i = 200; i < 250; ++i) laser[i].status.health = Health::Lost;
  const FusedOdometry fused = fuseOdometry(stereo, laser, kLidar);
  Pose pose;
  for (std::size_t i = 0; i < fused.steps.size(); ++i) {
    EXPECT_EQ(fused.sources[i], i >= 100 && i < 150   ? StepSource::Laser
                                : i >= 200 && i < 250 ? StepSource::Stereo
                                                      : StepSource::Both)
        << i;
    const Vector6d error =
        boxMinus(fused.steps[i].T_from_to, truthAt(stereo[i].from).inverse() * truthAt(stereo[i].to));
    EXPECT_LT(error.dot(SmallCholesky<6>(fused.steps[i].covariance).solve(error)), 40.0) << "a jump at step " << i;
  }
  EXPECT_EQ(fused.steps[120].status.health, Health::Degraded);
  EXPECT_NE(fused.steps[120].status.sentence.find("LiDAR"), std::string::npos);
  EXPECT_LT(endError(fused.steps), 0.3);
}

TEST(FuseOdometry, WithoutSweepsTheChainIsThatOfStereo) {
  urban_nav_core::testing::Dice dice(5);
  const auto stereo = stereoChain(20, 100'000'000, {}, dice);
  const FusedOdometry fused = fuseOdometry(stereo, {}, kLidar);
  EXPECT_TRUE(fused.shared.empty());
  for (std::size_t i = 0; i < stereo.size(); ++i) {
    EXPECT_TRUE(isApprox(fused.steps[i].T_from_to, stereo[i].T_from_to, 1e-12));
    EXPECT_TRUE(fused.steps[i].covariance.isApprox(stereo[i].covariance));
    EXPECT_EQ(fused.sources[i], StepSource::Stereo);
  }
}

TEST(FuseOdometry, AConflictIsNamedAndItsCovarianceGrows) {
  urban_nav_core::testing::Dice dice(6);
  const auto stereo = stereoChain(200, 100'000'000, {}, dice);
  auto laser = laserChain(200, 100'000'000, 0, {}, dice);
  for (std::size_t i = 100; i < 110; ++i) {  // a train moves past the robot
    Vector6d slip = Vector6d::Zero();
    slip[0] = 0.05;
    laser[i].T_from_to = boxPlus(laser[i].T_from_to, slip);
  }
  const FusedOdometry fused = fuseOdometry(stereo, laser, kLidar);
  ASSERT_FALSE(fused.conflicts.empty());
  EXPECT_LE(fused.conflicts.size(), 2U);
  EXPECT_LE(fused.conflicts.front().from, stereo[105].from);
  EXPECT_GE(fused.conflicts.back().to, stereo[105].to);
  EXPECT_NEAR(fused.conflicts.front().distance_m, 0.5, 0.1);
  EXPECT_GT(fused.steps[105].covariance.trace(), 10.0 * fused.steps[50].covariance.trace());
  EXPECT_LT(std::abs(constant(fused, "scale").value), 1e-3) << "the decision is made per stretch";
}

}  // namespace
