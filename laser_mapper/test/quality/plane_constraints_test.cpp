// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/plane_constraints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "support/drifting_pass.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace laser_mapper {
namespace {

using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector6d;

constexpr StampNs kFirstPose = 1'225'719'872'000'000'000, kPassTime = 60'000'000'000;
constexpr double kBias = 0.003;

struct Plane {
  Vector3d p, normal;
};
const Plane kWallAhead[] = {{{9.0, -2.0, 1.0}, -Vector3d::UnitX()},
                            {{9.0, 2.0, 1.0}, -Vector3d::UnitX()},
                            {{9.0, 0.0, 3.0}, -Vector3d::UnitX()},
                            {{9.0, 0.5, 0.5}, -Vector3d::UnitX()}};
const Plane kWallBeside[] = {{{0.0, 5.0, 1.0}, -Vector3d::UnitY()},
                             {{3.0, 5.0, 1.0}, -Vector3d::UnitY()},
                             {{3.0, 5.0, 3.0}, -Vector3d::UnitY()},
                             {{6.0, 5.0, 2.0}, -Vector3d::UnitY()}};
const Plane kFloor[] = {
    {{0.0, 2.0, 0.0}, Vector3d::UnitZ()}, {{3.0, -3.0, 0.0}, Vector3d::UnitZ()}, {{6.0, 3.0, 0.0}, Vector3d::UnitZ()}};

/// Robot that stands at one pose per pass, `passes` of them a minute apart, and whose map has pose i at boxPlus(true
/// pose, drift of i).
class PlaneConstraintTest : public ::testing::Test {
 protected:
  void stand(const std::vector<Vector6d>& drifts) {
    for (std::size_t i = 0; i < drifts.size(); ++i) {
      const double step = static_cast<double>(i);
      truth_.emplace_back(Eigen::Quaterniond(Eigen::AngleAxisd(0.4 + 0.3 * step, Vector3d::UnitZ())),
                          Vector3d(1.0 + 0.5 * step, 0.2 * step, 0.1));
      mapped_.push_back(urban_nav_core::boxPlus(truth_[i], drifts[i]));
      trajectory_.append(kFirstPose + static_cast<StampNs>(i) * kPassTime, mapped_[i]);
    }
  }
  template <std::size_t N>
  void see(const Plane (&planes)[N]) {
    for (const Plane& plane : planes) places_.push_back(seen(plane));
  }
  /// Returns the patches of a plane, measured exactly in each pass at a different part of the plane.
  PlanePlace seen(const Plane& plane) const {
    PlanePlace place;
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      const Pose T_map_true = mapped_[i] * truth_[i].inverse();
      PlanePatch patch;
      patch.pass = static_cast<std::uint16_t>(i);
      patch.stamp = trajectory_[i].stamp;
      patch.centre = T_map_true * (plane.p + 0.1 * static_cast<double>(i) * plane.normal.unitOrthogonal());
      patch.normal = T_map_true.q() * plane.normal;
      patch.displacement_sigma = 0.0004;
      patch.angle_sigma = 0.001;
      place.patches.push_back(patch);
      for (std::size_t before = 0; before < i; ++before) place.pairs.push_back({before, i, 0.0, 0.0});
    }
    return place;
  }
  std::vector<PlaneConstraint> find() const { return findPlaneConstraints(places_, {&trajectory_}, kBias, {nullptr}); }
  /// Returns the error of a measured transform, in the axes of pose a.
  Vector6d errorOf(const PlaneConstraint& constraint, std::size_t a = 0, std::size_t b = 1) const {
    return urban_nav_core::boxMinus(constraint.measured.T_a_b, truth_[a].inverse() * truth_[b]);
  }

  std::vector<Pose> truth_, mapped_;
  Trajectory trajectory_;
  std::vector<PlanePlace> places_;
};

Vector6d drift() { return (Vector6d() << 0.06, -0.04, 0.03, 0.003, -0.002, 0.006).finished(); }

TEST_F(PlaneConstraintTest, WallsAndFloorGiveTheTrueRelativePose) {
  stand({Vector6d::Zero(), drift()});
  see(kWallAhead);
  see(kWallBeside);
  see(kFloor);
  const auto constraints = find();
  ASSERT_EQ(constraints.size(), 1U);
  EXPECT_EQ(constraints[0].stamp_a, kFirstPose);
  EXPECT_EQ(constraints[0].stamp_b, kFirstPose + kPassTime);
  EXPECT_EQ(constraints[0].planes, 11U);
  // The equations are linearised in the rotation: the remaining error is of second order, 10 m of lever times the
  // square of 7 mrad.
  EXPECT_LT(errorOf(constraints[0]).head<3>().norm(), 1e-3);
  EXPECT_LT(errorOf(constraints[0]).tail<3>().norm(), 1e-4);
  EXPECT_GT(urban_nav_core::smallEigen<6>(constraints[0].measured.information).values(0), 1.0);
}

TEST_F(PlaneConstraintTest, OneWallConstrainsNeitherItsPlaneNorTheTurnAboutItsNormal) {
  stand({Vector6d::Zero(), drift()});
  see(kWallAhead);
  const auto constraints = find();
  ASSERT_EQ(constraints.size(), 1U);
  const Matrix6d& information = constraints[0].measured.information;
  const auto values = urban_nav_core::smallEigen<6>(information).values;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(values(i), 0.0, 1e-9 * values(5));
  EXPECT_GT(values(3), 0.0);
  // Residual of the ground truth: zero in directions with information from the wall.
  const Vector6d error = errorOf(constraints[0]);
  EXPECT_LT(error.dot(information * error), 0.1);
  EXPECT_GT(error.head<3>().norm(), 0.03) << "along the wall, the error of the map remains";
  // A motion of pose b along the wall has no residual.
  const Vector3d along = truth_[0].q().conjugate() * Vector3d::UnitY();
  Vector6d slide = Vector6d::Zero();
  slide.head<3>() = along;
  EXPECT_LT(slide.dot(information * slide), 0.02 * values(5)) << "drift turns the wall by a few mrad in the map";
}

TEST_F(PlaneConstraintTest, APlaneThatContradictsTheOthersIsLeftOut) {
  stand({Vector6d::Zero(), drift()});
  see(kWallAhead);
  see(kWallBeside);
  see(kFloor);
  places_[2].patches[1].centre.x() += 0.08;  // another surface
  const auto constraints = find();
  ASSERT_EQ(constraints.size(), 1U);
  EXPECT_EQ(constraints[0].planes, 10U);
  EXPECT_LT(errorOf(constraints[0]).head<3>().norm(), 1e-3);
}

TEST_F(PlaneConstraintTest, FewPlanesAndSmearedOnesGiveNothing) {
  stand({Vector6d::Zero(), drift()});
  see(kWallAhead);
  std::vector<PlanePlace> all = places_;
  places_.resize(2);
  EXPECT_TRUE(find().empty());
  places_ = all;
  for (PlanePlace& place : places_) place.patches[0].stamp_spread = 5.0;
  EXPECT_TRUE(find().empty()) << "seen twice in one pass, from poses far apart";
  EXPECT_TRUE(findPlaneConstraints({}, {&trajectory_}, kBias, {nullptr}).empty());
}

TEST_F(PlaneConstraintTest, APlaneOfManyPassesCountsOncePerPass) {
  stand({Vector6d::Zero(), drift()});
  see(kFloor);
  const Matrix6d two = find().at(0).measured.information;
  truth_.clear();
  mapped_.clear();
  places_.clear();
  trajectory_ = Trajectory();
  const Vector6d none = Vector6d::Zero();
  stand({none, none, none, none});
  see(kFloor);
  const auto constraints = find();
  ASSERT_EQ(constraints.size(), 6U);
  // Heights: one pair of two passes against six of four, of which only three are independent.
  const auto heightVariance = [](const Matrix6d& information) { return 1.0 / information(2, 2); };
  EXPECT_GT(heightVariance(two), 2.0 * kBias * kBias) << "the lasers' errors do not average out over the planes";
  EXPECT_LT(heightVariance(two), 4.0 * kBias * kBias);
  for (const PlaneConstraint& constraint : constraints)
    EXPECT_NEAR(heightVariance(constraint.measured.information), 2.0 * heightVariance(two), 0.2 * heightVariance(two));
}

TEST_F(PlaneConstraintTest, LasersOnExchangedSidesMeasureTheRollWithinTheirConstantErrors) {
  stand({Vector6d::Zero(), Vector6d::Zero()});
  for (int i = 0; i < 30; ++i)
    for (const double y : {-4.0, 4.0}) places_.push_back(seen({{0.1 * i, y, 0.0}, Vector3d::UnitZ()}));
  const std::vector<PlanePlace> exact = places_;
  constexpr double kFacing = 0.4;
  constexpr int kTrials = 100;
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, kBias);
  double ratio = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::array<double, 2> errors = {normal(random), normal(random)};
    places_ = exact;
    for (PlanePlace& place : places_)
      for (PlanePatch& patch : place.patches) {
        patch.laser = (patch.centre.y() > 0.0) == (patch.pass == 0) ? 0 : 1;  // the second pass drives back
        patch.facing = kFacing;
        patch.centre.z() -= kFacing * errors[patch.laser];
      }
    const auto constraints = find();
    ASSERT_EQ(constraints.size(), 1U);
    // About the direction with the lasers to its left and right, in the axes of pose a.
    const Vector3d ahead = mapped_[0].q().conjugate() * Vector3d::UnitX();
    const Matrix6d covariance = urban_nav_core::pseudoInverse(constraints[0].measured.information, 1e-9).value();
    const double roll = ahead.dot(errorOf(constraints[0]).tail<3>());
    ratio += roll * roll / ahead.dot(covariance.bottomRightCorner<3, 3>() * ahead) / kTrials;
  }
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2.5);  // twice as large where all errors add up; 5 without the part of the lasers
}

/// Constraint from two passes along ground and a wall, with odometry that drifts during each pass.
struct DriftTrial {
  Matrix6d information = Matrix6d::Zero();
  Vector6d error = Vector6d::Zero();
};

DriftTrial tryDrift(std::mt19937& random, double range_bias, bool is_stated) {
  const testing_drift::DriftingPass first(kFirstPose, testing_drift::walkRate(), random);
  const testing_drift::DriftingPass second(kFirstPose + kPassTime, testing_drift::walkRate(), random);
  std::vector<Plane> planes;
  for (const double x : {0.7, 1.4, 2.0, 2.6, 3.3}) {
    for (const double y : {-4.0, -2.0, 2.0, 4.0}) planes.push_back({{x, y, 0.0}, Vector3d::UnitZ()});
    for (const double z : {1.0, 3.0}) planes.push_back({{x, 6.0, z}, -Vector3d::UnitY()});
  }
  std::vector<PlanePlace> places;
  for (const Plane& plane : planes) {
    PlanePlace place;
    place.patches = {first.see(plane.p, plane.normal), second.see(plane.p, plane.normal)};
    place.patches[1].session = place.patches[1].pass = 1;
    place.pairs.push_back({0, 1, 0.0, 0.0});
    places.push_back(place);
  }
  const OdometryDrift none;
  const auto constraints = findPlaneConstraints(places, {&first.mapped, &second.mapped}, range_bias,
                                                {is_stated ? &first.drift : &none, is_stated ? &second.drift : &none});
  DriftTrial trial;
  EXPECT_EQ(constraints.size(), 1U);
  if (constraints.empty()) return trial;
  const auto at = [](const Trajectory& trajectory, StampNs stamp) {
    return trajectory[trajectory.nearest(stamp)].pose;
  };
  trial.information = constraints[0].measured.information;
  trial.error =
      urban_nav_core::boxMinus(constraints[0].measured.T_a_b, at(first.truth, constraints[0].stamp_a).inverse() *
                                                                  at(second.truth, constraints[0].stamp_b));
  return trial;
}

/// Means over walks: normalised squared errors of all coordinates and of the pitch; standard deviation of the pitch,
/// rad.
struct DriftErrors {
  double nees = 0.0, pitch = 0.0, pitch_sigma = 0.0;
};

DriftErrors meanErrors(int trials, double range_bias, bool is_stated) {
  std::mt19937 random(17);
  DriftErrors errors;
  for (int i = 0; i < trials; ++i) {
    const DriftTrial trial = tryDrift(random, range_bias, is_stated);
    const double variance = urban_nav_core::pseudoInverse(trial.information, 1e-9).value()(4, 4);
    errors.nees += trial.error.dot(trial.information * trial.error) / trials;
    errors.pitch += trial.error(4) * trial.error(4) / variance / trials;
    errors.pitch_sigma += std::sqrt(variance) / trials;
  }
  return errors;
}

TEST(PlaneConstraintDrift, ErrorsAreThoseStatedWhereOdometryStatesItsDrift) {
  constexpr int kTrials = 200;
  const DriftErrors errors = meanErrors(kTrials, 1e-5, true);  // nothing but drift
  const double limit = 3.5 * std::sqrt(2.0 / kTrials);
  EXPECT_NEAR(errors.nees / 5.0, 1.0, limit / std::sqrt(5.0)) << "rank 5: no information along the path";
  EXPECT_NEAR(errors.pitch, 1.0, limit);
  EXPECT_GT(errors.pitch_sigma, 0.001);
  EXPECT_LT(errors.pitch_sigma, 0.006) << "drift of both passes over 4 s";
}

TEST(PlaneConstraintDrift, NoiseOfTheLasersDoesNotExplainIt) {
  const DriftErrors errors = meanErrors(50, kBias, false);
  EXPECT_LT(errors.pitch_sigma, 0.0014) << "less than a third of the drift, overlap of patches included";
  EXPECT_GT(errors.pitch, 6.0) << "where odometry states no drift";
}

}  // namespace
}  // namespace laser_mapper
