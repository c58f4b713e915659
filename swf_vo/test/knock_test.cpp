// SPDX-License-Identifier: BSD-3-Clause
// A camera of the pair that is knocked while the robot drives, as a whole odometry measures and corrects it.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "recordings.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Quaterniond;
using urban_nav_core::Vector3d;
using urban_nav_core::testing::Motion;
using urban_nav_core::testing::namedMotion;
using urban_nav_core::testing::RenderedSequence;
using urban_nav_core::testing::SequenceOptions;
using urban_nav_core::testing::texturedRoom;

constexpr int kKnockFrames = 60, kKnocked = 25;
constexpr double kDegrees = M_PI / 180.0;

/// A drive through the rendered room whose right camera is turned by `knock` (rotation vector, rad) in the frames
/// kKnocked <= i < until.
class KnockedDrive {
 public:
  explicit KnockedDrive(const Vector3d& knock, int until = kKnockFrames) {
    const Motion motion = namedMotion("wander", "room", 1);
    SequenceOptions options;
    options.camera = roomCamera();
    options.noise = 1.0;
    const Pose T_left_right(Quaterniond::Identity(), Vector3d(options.camera.baseline, 0.0, 0.0));
    const Quaterniond q =
        knock.isZero() ? Quaterniond::Identity() : Quaterniond(Eigen::AngleAxisd(knock.norm(), knock.normalized()));
    const Pose T_left_knocked = T_left_right * Pose(q, Vector3d::Zero()) * T_left_right.inverse();
    RenderedSequence sound(texturedRoom(), motion, options);
    RenderedSequence knocked(
        texturedRoom(), [=](double t) { return motion(t) * T_left_knocked; }, options);
    SwfVo filter(Parameters(), stereoCamera(), Pose());
    for (int i = 0; i < kKnockFrames; ++i) {
      const auto& pair = sound.frame(i);
      const bool is_knocked = i >= kKnocked && i < until;
      const auto& right = is_knocked ? knocked.frame(i) : pair;
      const Frame& frame = filter.process({sound.stamp(i), pair.pair().left, right.pair().right});
      turns.push_back(frame.statistics.right_turn_rad);
      steps.push_back(frame.statistics.disparity_step);
      lost += frame.status.health == urban_nav_core::Health::Lost ? 1 : 0;
      estimated.push_back(frame.T_odom_base.pose);
      exact.push_back(motion(urban_nav_core::secondsBetween(sound.stamp(0), sound.stamp(i))));
    }
  }

  /// Returns the distance of the last position from the truth over the length of the path, from the first pose on.
  double endError() const {
    double length = 0.0;
    for (std::size_t i = 1; i < exact.size(); ++i) length += (exact[i].t() - exact[i - 1].t()).norm();
    const Pose truth = exact.front().inverse() * exact.back(), found = estimated.front().inverse() * estimated.back();
    return (truth.t() - found.t()).norm() / length;
  }

  std::vector<Vector3d> turns;
  std::vector<DisparityStep> steps;
  std::vector<Pose> estimated, exact;
  int lost = 0;
};

TEST(Knock, NoneIsFoundWhereThereIsNone) {
  const KnockedDrive drive(Vector3d::Zero());
  for (const Vector3d& turn : drive.turns) EXPECT_TRUE(turn.isZero(0.0));
}

TEST(Knock, IsCorrectedFromItsFrameOn) {
  const double sound = KnockedDrive(Vector3d::Zero()).endError();
  for (const Vector3d& degrees : {Vector3d(0.0, 0.3, 0.0), Vector3d(0.0, -1.0, 0.0), Vector3d(0.2, 0.3, -0.2),
                                  Vector3d(0.0, 0.0, 1.0), Vector3d(0.0, 0.06, 0.0)}) {
    const Vector3d knock = degrees * kDegrees;
    const KnockedDrive drive(knock);
    EXPECT_TRUE(drive.turns[kKnocked - 1].isZero(0.0)) << degrees.transpose();
    EXPECT_LT((drive.turns[kKnocked] - knock).norm(), 0.1 * knock.norm()) << degrees.transpose();
    EXPECT_EQ(drive.lost, 0) << degrees.transpose();
    EXPECT_LT(drive.endError(), sound + 0.01) << degrees.transpose();
  }
}

// No point can be matched along rows then: one frame is lost, in which rows are searched widely.
TEST(Knock, ALargePitchIsCorrectedAfterOneFrame) {
  const double sound = KnockedDrive(Vector3d::Zero()).endError();
  const Vector3d knock = Vector3d(2.0, 0.3, 0.0) * kDegrees;
  const KnockedDrive drive(knock);
  EXPECT_TRUE(drive.turns[kKnocked].isZero(0.0));
  EXPECT_LT((drive.turns[kKnocked + 1] - knock).norm(), 0.05 * knock.norm());
  EXPECT_EQ(drive.lost, 1);
  EXPECT_LT(drive.endError(), sound + 0.02);
}

TEST(Knock, StaysInTheDisparityStepUntilLandmarksAreRenewed) {
  constexpr double kYaw = 0.3 * kDegrees;
  const KnockedDrive drive(Vector3d(0.0, kYaw, 0.0));
  const double px = roomCamera().fx * kYaw;
  for (int i = kKnocked; i < kKnocked + 10; ++i)
    EXPECT_NEAR(drive.steps[static_cast<std::size_t>(i)].px, px, 0.15 * px) << i;
}

TEST(Knock, OfACameraThatSpringsBackIsTakenBack) {
  const KnockedDrive drive(Vector3d(0.0, 0.5 * kDegrees, 0.0), kKnocked + 15);
  EXPECT_GT(drive.turns[kKnocked + 10].norm(), 0.4 * kDegrees);
  EXPECT_LT(drive.turns.back().norm(), 0.05 * kDegrees);
}

}  // namespace
}  // namespace swf_vo
