// SPDX-License-Identifier: BSD-3-Clause
// Score of a landmark for a constant-rate drift of the camera, with known drifts.
#include "window/landmark_score.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "window/gauge.hpp"

namespace swf_vo {
namespace {

using Eigen::Vector3d;
using urban_nav_core::boxPlus;
using urban_nav_core::expSe3;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

constexpr double kStepRad = 0.02;  // view change of a step

const urban_nav_core::StereoCamera& camera() {
  static const urban_nav_core::StereoCamera camera{{400.0, 400.0, 255.5, 191.5, 512, 384}, 0.12};
  return camera;
}

/// A landmark observed along a path, whose poses have an error that grows by `drift` per radian of view change.
struct SeenLandmark {
  LandmarkBlock landmark;
  std::vector<PoseBlock> poses;

  SeenLandmark(const Vector3d& p_world, int steps, const Vector6d& drift, double sigma_px = 0.0, unsigned seed = 1) {
    const SensorModel sensor(camera());
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise;
    for (int i = 0; i < steps; ++i) {
      Vector6d twist;
      twist << 0.02 * i, 0.005 * i, 0.05 * i, 0.001 * i, 0.003 * i, -0.002 * i;
      const Pose truth = expSe3(twist);
      PoseBlock pose;
      pose.frame = i;
      // The true pose is the estimate displaced by the drift.
      pose.estimate = boxPlus(truth, -(kStepRad * i) * gauge::ofPose(truth, Vector3d::Zero()) * drift);
      pose.linearised = pose.estimate;
      poses.push_back(pose);
      Anchor anchor;
      Vector3d z;
      const Vector3d theta(p_world.x() / p_world.z(), p_world.y() / p_world.z(), 1.0 / p_world.z());
      EXPECT_TRUE(sensor.predict(anchor, theta, PoseMatrices(truth), z));
      Measurement measurement;
      measurement.step = i;
      measurement.z = z + sigma_px * Vector3d(noise(generator), noise(generator), noise(generator));
      measurement.information = Eigen::Matrix3d::Identity() / 0.09;
      landmark.seen.push_back(measurement);
      if (i == 0) landmark.estimate = landmark.linearised = theta;
    }
    landmark.used = true;
  }

  LandmarkScore score(double from = 0.0) const {
    const Cost cost(SensorModel(camera()), 0.0, true);
    LandmarkScore score;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      State state;
      score.add(landmark, poses[i], from + kStepRad * static_cast<double>(i),
                cost.sensorTerm(state, landmark, landmark.seen[i], poses[i]));
    }
    return score;
  }
};

std::vector<Vector3d> somePoints() {
  std::vector<Vector3d> points;
  for (int i = 0; i < 12; ++i) points.emplace_back(-1.5 + 0.3 * i, -0.8 + 0.6 * (i % 4), 3.0 + 1.3 * (i % 5));
  return points;
}

TEST(LandmarkScore, LandmarksTogetherFindTheDrift) {
  Vector6d drift;
  drift << 0.004, -0.003, 0.006, 0.001, 0.002, -0.0015;
  Matrix6d information = Matrix6d::Zero();
  Vector6d score = Vector6d::Zero();
  Pose last;
  for (const Vector3d& point : somePoints()) {
    const SeenLandmark seen(point, 10, drift);
    const DriftScore one = seen.score().evaluate(Pose());
    information += one.information;
    score += one.score;
    EXPECT_NEAR(one.life, 9 * kStepRad, 1e-12);
  }
  const Vector6d found = information.ldlt().solve(score);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i], drift[i], 0.02 * drift.norm()) << i;
}

TEST(LandmarkScore, LandmarksTogetherFindDriftAndOffset) {
  Vector6d drift;
  drift << 0.004, -0.003, 0.006, 0.001, 0.002, -0.0015;
  constexpr double kOffsetPx = 0.02;
  Eigen::Matrix<double, 7, 7> information = Eigen::Matrix<double, 7, 7>::Zero();
  Eigen::Matrix<double, 7, 1> score = Eigen::Matrix<double, 7, 1>::Zero();
  for (const Vector3d& point : somePoints()) {
    SeenLandmark seen(point, 10, drift);
    for (Measurement& measurement : seen.landmark.seen) measurement.z += kOffsetPx * Vector3d::UnitZ();
    const DriftScore one = seen.score().evaluate(Pose());
    information.topLeftCorner<6, 6>() += one.information;
    information.topRightCorner<6, 1>() += one.offset_cross;
    information.bottomLeftCorner<1, 6>() += one.offset_cross.transpose();
    information(6, 6) += one.offset_information;
    score.head<6>() += one.score;
    score[6] += one.offset_score;
  }
  const Eigen::Matrix<double, 7, 1> found = information.ldlt().solve(score);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found[i], drift[i], 0.02 * drift.norm()) << i;
  EXPECT_NEAR(found[6], -kOffsetPx, 0.05 * kOffsetPx) << "a larger offset shifts the right image to the left";
}

TEST(LandmarkScore, RefersToTheCamera) {
  Vector6d drift;
  drift << 0.004, -0.003, 0.006, 0.001, 0.002, -0.0015;
  const DriftScore first = SeenLandmark({0.5, 0.2, 4.0}, 10, drift).score().evaluate(Pose());
  Vector6d twist;
  twist << 1.0, -2.0, 3.0, 0.3, 0.5, -0.2;
  const Pose there = expSe3(twist);
  const DriftScore other = SeenLandmark({0.5, 0.2, 4.0}, 10, drift).score().evaluate(there);
  // The same drift about the other camera, in its axes.
  Matrix6d R = Matrix6d::Zero();
  R.topLeftCorner<3, 3>() = R.bottomRightCorner<3, 3>() = there.R();
  const Matrix6d T = gauge::transport(there.t(), Vector3d::Zero()) * R;
  EXPECT_LT((other.score - T.transpose() * first.score).norm(), 1e-9 * first.score.norm());
  EXPECT_LT((other.information - T.transpose() * first.information * T).norm(), 1e-9 * first.information.norm());
}

TEST(LandmarkScore, WhereTheClockStartsDoesNotMatter) {
  const SeenLandmark seen({0.5, 0.2, 4.0}, 10, Vector6d::Constant(0.002), 0.3);
  const DriftScore a = seen.score(0.0).evaluate(Pose()), b = seen.score(7.0).evaluate(Pose());
  EXPECT_LT((a.score - b.score).norm(), 1e-6 * a.score.norm());
  EXPECT_LT((a.information - b.information).norm(), 1e-6 * a.information.norm());
}

TEST(LandmarkScore, WhereTheLandmarkIsTakenToBeDoesNotMatter) {
  SeenLandmark seen({0.5, 0.2, 4.0}, 10, Vector6d::Constant(0.002), 0.3);
  const DriftScore at_truth = seen.score().evaluate(Pose());
  seen.landmark.estimate += Vector3d(1e-4, -1e-4, 1e-5);
  const DriftScore beside = seen.score().evaluate(Pose());
  EXPECT_LT((at_truth.score - beside.score).norm(), 1e-2 * at_truth.score.norm());
}

TEST(LandmarkScore, HasTheVarianceOfItsInformation) {
  Matrix6d squares = Matrix6d::Zero(), information = Matrix6d::Zero();
  constexpr int kRuns = 2000;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    const DriftScore one = SeenLandmark({0.5, 0.2, 4.0}, 10, Vector6d::Zero(), 0.3, seed).score().evaluate(Pose());
    squares += one.score * one.score.transpose() / kRuns;
    information = one.information;
  }
  // The relative standard deviation of a variance estimate is the root of 2 / runs.
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(squares(i, i) / information(i, i), 1.0, 5.0 * std::sqrt(2.0 / kRuns)) << i;
}

TEST(LandmarkScore, AgeingLosesInformationAndIsAdditive) {
  const SeenLandmark seen({0.5, 0.2, 4.0}, 10, Vector6d::Constant(0.002), 0.3);
  Eigen::Matrix2d Q;
  Q << 3e-6, 1e-6, 1e-6, 2e-6;
  LandmarkScore once = seen.score(), twice = once;
  const Matrix6d fresh = once.evaluate(Pose()).information;
  once.age(2.0 * Q);
  twice.age(Q);
  twice.age(Q);
  const DriftScore a = once.evaluate(Pose()), b = twice.evaluate(Pose());
  EXPECT_LT((a.information - b.information).norm(), 1e-9 * a.information.norm());
  EXPECT_LT((a.score - b.score).norm(), 1e-9 * a.score.norm());
  // theta is eliminated: the information on a drift is independent of that on the future of theta.
  EXPECT_LT((a.information - fresh).norm(), 1e-9 * fresh.norm());
}

TEST(LandmarkScore, ProcessNoiseReducesItsInformation) {
  const SeenLandmark seen({0.5, 0.2, 4.0}, 10, Vector6d::Zero(), 0.3);
  const Cost cost(SensorModel(camera()), 0.0, true);
  LandmarkScore aged;
  for (std::size_t i = 0; i < seen.poses.size(); ++i) {
    State state;
    aged.age(1e-6 * Eigen::Matrix2d::Identity());
    aged.add(seen.landmark, seen.poses[i], kStepRad * static_cast<double>(i),
             cost.sensorTerm(state, seen.landmark, seen.landmark.seen[i], seen.poses[i]));
  }
  const Matrix6d lost = seen.score().evaluate(Pose()).information - aged.evaluate(Pose()).information;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(lost);
  EXPECT_GT(eigen.eigenvalues().maxCoeff(), 0.1 * lost.trace());
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-9 * lost.trace());
}

}  // namespace
}  // namespace swf_vo
