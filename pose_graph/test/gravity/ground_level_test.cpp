// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/ground_level.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "urban_nav_core/testing/dice.hpp"

namespace pose_graph {
namespace {

using Eigen::Vector3d;
using urban_nav_core::expSo3;
using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_core::testing::Dice;

constexpr double kDegree = M_PI / 180.0;

double degreesApart(const Vector3d& a, const Vector3d& b) { return std::asin(a.cross(b).norm()) / kDegree; }

/// A robot that drives curves on level ground, in a world frame tilted against gravity.
struct GroundDrive {
  Pose T_world_level{expSo3(Vector3d(0.05, -0.12, 0.7)), Vector3d(3.0, 1.0, 0.0)};
  int keyframes = 200;
  double slopes = 0.0;  ///< rad, amplitude of a wave of 20 m length

  Vector3d trueUp() const { return T_world_level.R() * Vector3d::UnitZ(); }
  Trajectory trajectory() const {
    Trajectory made;
    for (int i = 0; i < keyframes; ++i) made.append(i * 250'000'000LL, T_world_level * base(i));
    return made;
  }
  std::vector<GroundNormal> normals(Dice& dice, double noise) const {
    std::vector<GroundNormal> made;
    for (int i = 0; i < keyframes; ++i) {
      const Vector3d error = noise * dice.normals<3>();
      const Vector3d up = Vector3d(slopes * std::sin(0.25 * i * 2.0 * M_PI / 20.0), 0.0, 1.0) + error;
      made.push_back({i * 250'000'000LL, base(i).R().transpose() * up.normalized(), noise});
    }
    return made;
  }

 private:
  /// Returns the robot's pose on the ground; poses are 0.25 m apart and rock.
  static Pose base(int i) {
    return Pose(expSo3(Vector3d(0.0, 0.0, 0.02 * i)) * expSo3(Vector3d(0.02 * std::sin(i), 0.05 * std::cos(i), 0.0)),
                Vector3d(0.25 * i, std::sin(0.05 * i), 0.0));
  }
};

TEST(GroundLevel, IsExactOnLevelGround) {
  Dice dice(1);
  const GroundDrive drive;
  const Level level = estimateLevel(drive.trajectory(), drive.normals(dice, 0.0), Pose());
  ASSERT_TRUE(level.known()) << level.sentence;
  EXPECT_LT(degreesApart(level.up, drive.trueUp()), 1e-6);
  EXPECT_TRUE(isFromGround(level));
  EXPECT_LT((level.R_map_first * level.up - Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(GroundLevel, IsRelativeToTheGivenPose) {
  Dice dice(1);
  const GroundDrive drive;
  const Pose later = drive.trajectory()[50].pose;
  const Level level = estimateLevel(drive.trajectory(), drive.normals(dice, 0.0), later);
  EXPECT_LT(degreesApart(later.R() * level.up, drive.trueUp()), 1e-6);
}

TEST(GroundLevel, AveragesNoiseAndSlopesAndIgnoresWalls) {
  Dice dice(3);
  GroundDrive drive;
  drive.slopes = 3.0 * kDegree;
  std::vector<GroundNormal> normals = drive.normals(dice, 0.3 * kDegree);
  for (std::size_t i = 0; i < normals.size(); i += 5) normals[i].up = Vector3d(0.5, 0.1, 0.8).normalized();
  normals[7].up.x() = std::numeric_limits<double>::quiet_NaN();
  normals[8].up *= 2.0;
  normals[9].stamp += 1;  // matches no pose
  const Level level = estimateLevel(drive.trajectory(), normals, Pose());
  ASSERT_TRUE(level.known());
  EXPECT_LT(degreesApart(level.up, drive.trueUp()), 0.5);
  EXPECT_LT(degreesApart(level.up, drive.trueUp()), 3.0 * level.sigma / kDegree);
}

TEST(GroundLevel, IsMoreCertainOnALongerPath) {
  Dice dice(1);
  GroundDrive drive;
  drive.keyframes = 40;
  const double brief = estimateLevel(drive.trajectory(), drive.normals(dice, 0.005), Pose()).sigma;
  drive.keyframes = 2000;
  const double extended = estimateLevel(drive.trajectory(), drive.normals(dice, 0.005), Pose()).sigma;
  EXPECT_LT(extended, 0.5 * brief);
  EXPECT_GT(brief, 0.8 * kDegree) << "a short stretch may be a slope";
}

TEST(GroundLevel, NeedsFiveKeyframes) {
  Dice dice(1);
  GroundDrive drive;
  drive.keyframes = 4;
  const Level level = estimateLevel(drive.trajectory(), drive.normals(dice, 0.0), Pose());
  EXPECT_EQ(level.trouble, LevelTrouble::TooShort);
  EXPECT_FALSE(level.sentence.empty());
  EXPECT_FALSE(estimateLevel(Trajectory(), drive.normals(dice, 0.0), Pose()).known());
}

}  // namespace
}  // namespace pose_graph
