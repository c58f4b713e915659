// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/calibration/view_calibration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

namespace laser_mapper {
namespace {

using Eigen::Vector3d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_registration::Picture;

constexpr int kViewWidth = 240, kViewHeight = 180, kViewCount = 45;
constexpr double kWallDistance = 4.0, kFocal = 150.0;
constexpr StampNs kViewStart = 1'000'000'000, kBetweenViews = 300'000'000;

/// Brightness of the wall y = 4 m, and of the ground.
double paint(double x, double y) {
  return 120.0 + 35.0 * std::sin(9.0 * x + 2.0 * y) + 30.0 * std::sin(7.0 * y - 4.0 * x) + 20.0 * std::sin(17.0 * x);
}

/// Camera that faces left, 1.2 m above and 0.3 m ahead of the robot's centre.
Pose leftCamera() {
  Eigen::Matrix3d R;
  R.col(0) = Vector3d::UnitX();
  R.col(1) = -Vector3d::UnitZ();
  R.col(2) = Vector3d::UnitY();
  return Pose(R, Vector3d(0.3, 0.0, 1.2));
}

/// The robot passes the wall at 1.2 m/s, with oscillating heading and roll. `slip`: to the left, m/s.
urban_nav_core::Trajectory drivenPath(double slip = 0.0) {
  urban_nav_core::Trajectory path;
  for (int i = 0; i < 320; ++i) {
    const double t = 0.05 * i - 1.0;
    path.append(std::llround(1e9 * t) + kViewStart,
                Pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.25 * std::sin(1.1 * t), Vector3d::UnitZ()) *
                                        Eigen::AngleAxisd(0.08 * std::sin(1.7 * t), Vector3d::UnitX())),
                     Vector3d(1.2 * t - 8.0, 0.2 * std::sin(0.7 * t) + slip * (t + 1.0), 0.0)));
  }
  return path;
}

/// Returns the image from a pose; each image has its own exposure.
Picture photograph(const Pose& T_map_camera, std::size_t image) {
  Picture picture{kViewWidth, kViewHeight, {}};
  const double exposure = 0.8 + 0.1 * static_cast<double>(image % 5);
  for (int v = 0; v < kViewHeight; ++v)
    for (int u = 0; u < kViewWidth; ++u) {
      const Vector3d ray = T_map_camera.q() * Vector3d((u - 120.0) / kFocal, (v - 90.0) / kFocal, 1.0);
      const double to_wall = (kWallDistance - T_map_camera.t().y()) / ray.y(),
                   to_ground = ray.z() < 0.0 ? -T_map_camera.t().z() / ray.z() : 1e9;
      const Vector3d p = T_map_camera.t() + std::min(to_wall, to_ground) * ray;
      const double painted = to_wall < to_ground ? paint(p.x(), p.z()) : paint(p.x(), 3.0 * p.y());
      const auto grey = static_cast<std::uint8_t>(std::clamp(exposure * painted, 0.0, 255.0));
      picture.bgr.insert(picture.bgr.end(), {grey, grey, grey});
    }
  return picture;
}

/// Points of wall and ground, each measured when the robot passes it. `given`: the trajectory used for rendering.
std::vector<MapPoint> surfacePoints(const urban_nav_core::Trajectory& path, const urban_nav_core::Trajectory& given) {
  std::vector<MapPoint> points;
  const auto add = [&](float x, float y, float z, const Eigen::Vector3f& normal) {
    MapPoint point;
    point.stamp = kViewStart + std::llround(1e9 * std::clamp((static_cast<double>(x) + 8.0) / 1.2, 0.0, 13.0));
    const Pose T_given_path = *given.at(point.stamp, kBetweenViews) * path.at(point.stamp, kBetweenViews)->inverse();
    point.p = (T_given_path * Vector3d(x, y, z)).cast<float>();
    point.normal = normal;
    points.push_back(point);
  };
  for (float x = -12.0F; x < 12.0F; x += 0.05F) {
    for (float z = 0.0F; z < 3.5F; z += 0.05F) add(x, static_cast<float>(kWallDistance), z, -Eigen::Vector3f::UnitY());
    for (float y = 1.0F; y < 4.0F; y += 0.05F) add(x, y, 0.0F, Eigen::Vector3f::UnitZ());
  }
  return points;
}

/// Calibrates images taken `late` seconds before their stamps along `path`, by a camera whose mounting differs from the
/// stated one by `turn` (rad, axes of the robot). `given`: the trajectory of odometry. `range_bias`: of the lasers, m;
/// here they are exact.
ViewCalibration calibrate(double late, const Vector3d& turn, const urban_nav_core::Trajectory& path,
                          const urban_nav_core::Trajectory& given,
                          const urban_nav_core::OdometryChain* odometry = nullptr, double range_bias = 0.0) {
  const Pose stated = leftCamera(),
             actual(Eigen::Matrix3d(urban_nav_core::expSo3(turn) * stated.q()), Vector3d(stated.t()));
  std::vector<MountedView> views;
  for (std::size_t i = 0; i < kViewCount; ++i) {
    MountedView view;
    view.camera.pinhole = {kFocal, kFocal, 120.0, 90.0, kViewWidth, kViewHeight};
    view.T_base_camera = stated;
    view.stamp = kViewStart + static_cast<StampNs>(i) * kBetweenViews;
    view.image = i;
    views.push_back(view);
  }
  ViewCalibrator calibrator(views, given, odometry, 0.05, range_bias);
  calibrator.addSurface(surfacePoints(path, given));
  return calibrator.estimate("panorama", [&](std::size_t image) {
    return photograph(*path.at(views[image].stamp - std::llround(1e9 * late), 1'000'000'000) * actual, image);
  });
}

ViewCalibration calibrate(double late, const Vector3d& turn, const urban_nav_core::Trajectory& path) {
  return calibrate(late, turn, path, path);
}

constexpr double kHeadDegree = M_PI / 180.0;

double adoptedTurn(const ViewCalibration& found, int axis) {
  return found.head.terms[static_cast<std::size_t>(4 + axis)].adopted;
}

TEST(ViewCalibration, LateImagesAreFound) {
  const ViewCalibration found = calibrate(0.02, Vector3d::Zero(), drivenPath());
  const CalibrationEstimate& delay = found.head.at(CalibrationTerm::Delay);
  EXPECT_TRUE(delay.constrained && found.isAdopted());
  EXPECT_NEAR(delay.adopted, 0.02, 0.002);
  EXPECT_LT(std::abs(delay.value - 0.02), 4.0 * delay.sigma);
  EXPECT_LT(found.calibrated_spread, 0.7 * found.stated_spread);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(adoptedTurn(found, axis), 0.0, 0.1 * kHeadDegree);
}

TEST(ViewCalibration, ATurnedHeadIsFoundAboutEachAxis) {
  const Vector3d turn = kHeadDegree * Vector3d(1.0, -0.7, 1.5);
  const ViewCalibration found = calibrate(0.0, turn, drivenPath());
  ASSERT_TRUE(found.isAdopted());
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(adoptedTurn(found, axis), turn(axis), 0.1 * kHeadDegree) << axis;
    const CalibrationEstimate& term = found.head.terms[static_cast<std::size_t>(4 + axis)];
    EXPECT_LT(std::abs(term.value - turn(axis)), 4.0 * term.sigma) << axis;
  }
  EXPECT_LT(found.calibrated_spread, 0.5 * found.stated_spread);
  const Pose corrected = found.headCorrection() * leftCamera();
  EXPECT_NEAR(angleBetween(corrected, Pose(urban_nav_core::expSo3(turn), Vector3d::Zero()) * leftCamera()), 0.0,
              0.1 * kHeadDegree);
  EXPECT_LT(distanceBetween(corrected, leftCamera()), 0.02) << "rotation without translation";
}

TEST(ViewCalibration, DistinguishesDelayAndTurn) {
  const ViewCalibration found = calibrate(-0.03, kHeadDegree * Vector3d(0.0, 0.0, 2.0), drivenPath());
  ASSERT_TRUE(found.isAdopted());
  EXPECT_NEAR(found.head.at(CalibrationTerm::Delay).adopted, -0.03, 0.003);
  EXPECT_NEAR(adoptedTurn(found, 2), 2.0 * kHeadDegree, 0.1 * kHeadDegree);
}

TEST(ViewCalibration, WhereNothingIsWrongNothingIsAdopted) {
  const ViewCalibration found = calibrate(0.0, Vector3d::Zero(), drivenPath());
  EXPECT_FALSE(found.head.isAdopted());
  EXPECT_GT(found.places, 10U);
  for (const CalibrationEstimate& term : found.head.terms)
    EXPECT_LT(std::abs(term.value), std::max(3.0 * term.sigma, 5e-4));
}

/// Odometry along a path, with a lateral uncertainty of `sigma_y` (m) per root second.
urban_nav_core::OdometryChain odometryAlong(const urban_nav_core::Trajectory& path, double sigma_y) {
  urban_nav_core::OdometryChain chain;
  for (std::size_t i = 1; i < path.size(); ++i) {
    urban_nav_core::RelativePose step;
    step.from = path[i - 1].stamp;
    step.to = path[i].stamp;
    step.T_from_to = path[i - 1].pose.inverse() * path[i].pose;
    const double share = urban_nav_core::secondsBetween(step.from, step.to);
    urban_nav_core::Vector6d variances;
    variances << 1e-6, sigma_y * sigma_y, 1e-6, 1e-7, 1e-7, 1e-7;
    step.covariance = (share * variances).asDiagonal();
    EXPECT_TRUE(chain.append(step));
  }
  return chain;
}

TEST(ViewCalibration, ASlipThatOdometryAllowsForIsWithinTheStatedSigma) {
  constexpr double kSlip = 0.004, kTurn = 1.0 * kHeadDegree;  // m/s: equivalent to a rotation of the head by 0.19 deg
  const urban_nav_core::Trajectory path = drivenPath(), given = drivenPath(-kSlip);
  const urban_nav_core::OdometryChain odometry = odometryAlong(given, 2.0 * kSlip);
  const ViewCalibration certain = calibrate(0.0, kTurn * Vector3d::UnitZ(), path, given),
                        found = calibrate(0.0, kTurn * Vector3d::UnitZ(), path, given, &odometry);
  const CalibrationEstimate &yaw = found.head.at(CalibrationTerm::TurnZ),
                            &certain_yaw = certain.head.at(CalibrationTerm::TurnZ);
  ASSERT_TRUE(found.isAdopted());
  EXPECT_LT(std::abs(yaw.value - kTurn), 3.0 * yaw.sigma);
  EXPECT_GT(yaw.sigma, certain_yaw.sigma);
  EXPECT_GT(std::abs(certain_yaw.value - kTurn), 4.0 * certain_yaw.sigma) << "an odometry of 1 mm a second excludes it";
  EXPECT_LT(std::abs(yaw.value - kTurn), 0.3 * std::abs(certain_yaw.value - kTurn));
}

TEST(ViewCalibration, AConstantErrorOfTheLasersIsInTheStatedSigma) {
  constexpr double kBias = 0.01;  // m; at about 6 m, equivalent to a rotation of the head by 1.7 mrad
  const Vector3d turn = kHeadDegree * Vector3d::UnitZ();
  const ViewCalibration exact = calibrate(0.0, turn, drivenPath()),
                        biased = calibrate(0.0, turn, drivenPath(), drivenPath(), nullptr, kBias);
  const CalibrationEstimate &yaw = biased.head.at(CalibrationTerm::TurnZ),
                            &exact_yaw = exact.head.at(CalibrationTerm::TurnZ);
  EXPECT_NEAR(yaw.value, exact_yaw.value, 1e-3);
  EXPECT_GT(yaw.sigma, exact_yaw.sigma + 5e-4);
  EXPECT_LT(yaw.sigma, exact_yaw.sigma + kBias / kWallDistance);
}

TEST(ViewCalibration, AStationaryRobotDoesNotDetermineIt) {
  urban_nav_core::Trajectory standing;
  for (const urban_nav_core::StampedPose& pose : drivenPath()) standing.append(pose.stamp, drivenPath()[60].pose);
  const ViewCalibration found = calibrate(0.02, kHeadDegree * Vector3d(0.0, 0.0, 1.0), standing);
  EXPECT_FALSE(found.head.at(CalibrationTerm::Delay).constrained);
  EXPECT_FALSE(found.head.isAdopted());
  EXPECT_NE(std::find(found.unconstrained.begin(), found.unconstrained.end(), "delay of panorama"),
            found.unconstrained.end());
}

TEST(ViewCalibration, WithoutViewsThereIsNothing) {
  const urban_nav_core::Trajectory path = drivenPath();
  const ViewCalibrator calibrator({}, path, nullptr, 0.05, 0.0);
  const ViewCalibration found = calibrator.estimate("panorama", [](std::size_t) { return Picture(); });
  EXPECT_EQ(found.places, 0U);
  EXPECT_FALSE(found.isAdopted());
}

}  // namespace
}  // namespace laser_mapper
