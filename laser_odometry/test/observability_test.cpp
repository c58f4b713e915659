// SPDX-License-Identifier: BSD-3-Clause
#include "observability.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/dice.hpp"

namespace laser_odometry {
namespace {

using urban_nav_core::Vector3d;
using urban_nav_core::testing::Dice;

PlaneRow makeRow(const Vector3d& p, const Vector3d& normal, double weight) { return {normal, p, 0.02, weight}; }

/// Walls across y, floor and ceiling of a tunnel along x; normals with errors of `tilt` rad.
std::vector<PlaneRow> makeTunnelRows(double tilt, double weight, int fronts) {
  Dice dice(5);
  std::vector<PlaneRow> rows;
  for (int i = 0; i < 800; ++i) {
    const double x = dice.uniform(-20.0, 20.0);
    const bool is_wall = i % 2 == 0;
    const Vector3d p = is_wall ? Vector3d(x, i % 4 == 0 ? 3.0 : -3.0, dice.uniform(-1.5, 3.0))
                               : Vector3d(x, dice.uniform(-3.0, 3.0), i % 4 == 1 ? -1.5 : 3.0);
    const Vector3d normal = (is_wall ? Vector3d::UnitY() : Vector3d::UnitZ()) + tilt * dice.normals<3>();
    rows.push_back(makeRow(p, normal.normalized(), weight));
  }
  for (int i = 0; i < fronts; ++i)
    rows.push_back(makeRow({15.0, dice.uniform(-3.0, 3.0), dice.uniform(-1.5, 3.0)}, Vector3d::UnitX(), weight));
  return rows;
}

TEST(Observability, NoiseOfNormalsIsNoInformation) {
  for (const double tilt : {0.0, 0.01, 0.03}) {
    for (const double weight : {1.0, 1e6}) {
      const FreeSubspace free = findFreeSubspace(makeTunnelRows(tilt, weight, 0));
      ASSERT_EQ(free.directions.size(), 1u) << tilt;
      EXPECT_GT(std::abs(free.directions[0][0]), std::cos(0.05)) << free.directions[0].transpose();
    }
  }
}

TEST(Observability, TheWallsOfALongCorridorHoldItsRoll) {
  Dice dice(8);
  std::vector<PlaneRow> rows;
  for (int i = 0; i < 1500; ++i) {
    const double x = dice.uniform(-30.0, 30.0), across = dice.uniform(-1.0, 1.0), side = i % 4 < 2 ? 1.0 : -1.0;
    rows.push_back(i % 2 == 0 ? makeRow({x, side, across}, Vector3d::UnitY(), 1.0)
                              : makeRow({x, across, side}, Vector3d::UnitZ(), 1.0));
  }
  for (int i = 0; i < 30; ++i) rows.push_back(makeRow({20.0, dice.uniform(-1.0, 1.0), 0.0}, Vector3d::UnitX(), 1.0));
  EXPECT_FALSE(findFreeSubspace(rows).isFree());
}

TEST(Observability, AFewSurfacesAcrossTheTunnelAreEnough) {
  EXPECT_FALSE(findFreeSubspace(makeTunnelRows(0.01, 1.0, 20)).isFree());
}

TEST(Observability, ThePlaneOfAFieldLeavesThreeDirections) {
  Dice dice(6);
  std::vector<PlaneRow> rows;
  for (int i = 0; i < 500; ++i)
    rows.push_back(makeRow({dice.uniform(-20, 20), dice.uniform(-20, 20), -1.7}, Vector3d::UnitZ(), 1.0));
  const FreeSubspace free = findFreeSubspace(rows);
  ASSERT_EQ(free.directions.size(), 3u);
  for (const Vector6d& v : free.directions) {
    EXPECT_NEAR(v[2], 0.0, 1e-6);
    EXPECT_NEAR(v.segment<2>(3).norm(), 0.0, 0.1);  // rotations about x and y are constrained
  }
  EXPECT_EQ(findFreeSubspace({}).directions.size(), 6u);
}

TEST(Observability, TheSolutionKeepsTheFreePartAndSolvesTheRest) {
  const std::vector<PlaneRow> rows = makeTunnelRows(0.0, 1.0, 0);
  const FreeSubspace free = findFreeSubspace(rows);
  Vector6d truth, along;
  truth << 0.0, 0.02, -0.01, 0.001, -0.002, 0.003;
  along << 0.5, 0, 0, 0, 0, 0;
  Matrix6d H = Matrix6d::Zero();
  for (const PlaneRow& row : rows) H += row.weight * row.jacobian() * row.jacobian().transpose();
  const Vector6d d = solveObserved(H, H * truth, free, along);
  EXPECT_NEAR(d[0], 0.5, 1e-6);
  EXPECT_LT((d - truth).tail<5>().norm(), 1e-6);
}

TEST(Observability, TheCovarianceIsTheInverseWhereObservedAndThePriorAlongTheFreeDirection) {
  const std::vector<PlaneRow> rows = makeTunnelRows(0.0, 100.0, 0);
  const FreeSubspace free = findFreeSubspace(rows);
  Matrix6d H = Matrix6d::Zero();
  for (const PlaneRow& row : rows) H += row.weight * row.jacobian() * row.jacobian().transpose();
  const Matrix6d C = covarianceOfObserved(H, free, 4.0 * Matrix6d::Identity());
  EXPECT_NEAR(C(0, 0), 4.0, 1e-6);
  const Eigen::Matrix<double, 5, 5> observed = H.bottomRightCorner<5, 5>();
  EXPECT_LT((C.bottomRightCorner<5, 5>() * observed - Eigen::Matrix<double, 5, 5>::Identity()).norm(), 1e-6);
}

TEST(Observability, OfPlanarMotionOnlyCoordinatesInThePlaneAreFreeOrObserved) {
  Dice dice(9);
  std::vector<PlaneRow> rows;  // a corridor along (0.8, 0.6)
  const Vector3d along(0.8, 0.6, 0.0), across(-0.6, 0.8, 0.0);
  for (int i = 0; i < 120; ++i)
    rows.push_back(makeRow(dice.uniform(-8.0, 8.0) * along + (i % 2 == 0 ? 1.2 : -1.2) * across,
                           (across + 0.02 * dice.normal() * along).normalized(), 1e4));
  const FreeSubspace free = findFreeSubspace(rows, MotionSpace::Planar);
  ASSERT_EQ(free.directions.size(), 1u);
  EXPECT_GT(std::abs(free.directions[0].head<3>().dot(along)), std::cos(0.05));
  EXPECT_EQ(free.evidence.size(), 3u);

  Matrix6d H = Matrix6d::Zero();
  for (const PlaneRow& row : rows) H += row.weight * row.jacobian() * row.jacobian().transpose();
  const Matrix6d C = covarianceOfObserved(H, free, 4.0 * Matrix6d::Identity());
  for (const int i : {2, 3, 4}) EXPECT_EQ(C.row(i).norm() + C.col(i).norm(), 0.0);
  EXPECT_NEAR(along.dot(C.topLeftCorner<3, 3>() * along), 4.0, 0.1);
  EXPECT_LT(across.dot(C.topLeftCorner<3, 3>() * across), 0.02);
  const Vector6d step = solveObserved(H, H * Vector6d::Constant(0.01), free, Vector6d::Zero());
  for (const int i : {2, 3, 4}) EXPECT_EQ(step[i], 0.0);

  for (int i = 0; i < 30; ++i) rows.push_back(makeRow(6.0 * along + dice.uniform(-1.0, 1.0) * across, along, 1e4));
  EXPECT_FALSE(findFreeSubspace(rows, MotionSpace::Planar).isFree());
  EXPECT_EQ(findFreeSubspace({}, MotionSpace::Planar).directions.size(), 3u);
}

}  // namespace
}  // namespace laser_odometry
