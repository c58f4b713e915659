// SPDX-License-Identifier: BSD-3-Clause
#include "gap_error.hpp"

#include <gtest/gtest.h>

namespace laser_odometry {
namespace {

/// A registration whose walls across x were first seen in a sweep.
struct WallsAcross {
  MapCell cell;
  Registration registration;

  explicit WallsAcross(std::int32_t first_sweep) {
    cell.first_sweep = first_sweep;
    PatchMatch match;
    match.cell = &cell;
    match.row = {Vector3d::UnitX(), Vector3d(5.0, 0.0, 0.0), 0.0, 1e4};
    registration.matches.assign(20, match);
  }
};

Matrix6d varianceAlongX(double variance) {
  Matrix6d C = Matrix6d::Zero();
  C(0, 0) = variance;
  return C;
}

TEST(GapError, OldSurfacesTakeTheErrorBack) {
  GapError gap;
  gap.extend(varianceAlongX(0.04), 1, 11);
  gap.extend(varianceAlongX(0.09), 1, 12);
  EXPECT_TRUE(gap.close(WallsAcross(10).registration).isApprox(varianceAlongX(0.13), 1e-9));
  EXPECT_TRUE(gap.close(WallsAcross(10).registration).isZero());  // once
}

TEST(GapError, SurfacesOfTheGapShareTheErrorOfThePose) {
  GapError gap;
  gap.extend(varianceAlongX(0.04), 1, 11);
  EXPECT_TRUE(gap.close(WallsAcross(11).registration).isZero());
}

TEST(GapError, ADirectionThatIsStillFreeStaysInTheGap) {
  GapError gap;
  Matrix6d both = varianceAlongX(0.04);
  both(1, 1) = 0.01;
  gap.extend(both, 2, 11);
  WallsAcross walls(3);
  walls.registration.free.directions = {Vector6d::Unit(1)};
  EXPECT_TRUE(gap.close(walls.registration).isApprox(varianceAlongX(0.04), 1e-9));
  walls.registration.free.directions.clear();
  for (PatchMatch& match : walls.registration.matches) match.row.normal = Vector3d::UnitY();
  EXPECT_NEAR(gap.close(walls.registration)(1, 1), 0.01, 1e-12);
}

TEST(GapError, AFreeDirectionThatTurnsALittleClosesNothing) {
  GapError gap;
  gap.extend(varianceAlongX(400.0), 1, 11);
  WallsAcross walls(3);
  walls.registration.free.directions = {Vector6d(Vector6d::Unit(0) + 1e-2 * Vector6d::Unit(1)).normalized()};
  for (PatchMatch& match : walls.registration.matches) match.row.normal = Vector3d::UnitY();
  EXPECT_TRUE(gap.close(walls.registration).isZero());
}

TEST(GapError, WithoutAGapNothingIsReturned) {
  GapError gap;
  gap.extend(Matrix6d::Zero(), 0, 5);
  EXPECT_TRUE(gap.close(WallsAcross(1).registration).isZero());
}

}  // namespace
}  // namespace laser_odometry
