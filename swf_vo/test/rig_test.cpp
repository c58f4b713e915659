// SPDX-License-Identifier: BSD-3-Clause
// Estimation of roll and shutter delay of the right camera by the whole odometry.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "recordings.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::testing::Motion;
using urban_nav_core::testing::namedMotion;
using urban_nav_core::testing::RenderedSequence;
using urban_nav_core::testing::SequenceOptions;
using urban_nav_core::testing::texturedRoom;

constexpr int kRigFrames = 50;

/// The rendered room with a right camera that is rotated about its optical axis and delayed.
RigConstants findRig(double roll_rad, double delay_s) {
  const Motion motion = namedMotion("wander", "room", 1);
  SequenceOptions options;
  options.camera = roomCamera();
  const Pose T_left_right(urban_nav_core::Quaterniond::Identity(),
                          urban_nav_core::Vector3d(options.camera.baseline, 0.0, 0.0));
  const Pose turned(urban_nav_core::Quaterniond(Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ())),
                    urban_nav_core::Vector3d::Zero());
  const Motion right_motion = [=](double t) {
    return motion(t + delay_s) * T_left_right * turned * T_left_right.inverse();
  };
  RenderedSequence left(texturedRoom(), motion, options), right(texturedRoom(), right_motion, options);
  Parameters parameters;
  parameters.shutter_delay = 5.0;  // two seconds of a slow camera are less informative than the usual prior
  SwfVo filter(parameters, stereoCamera(), Pose());
  RigConstants found;
  for (int i = 0; i < kRigFrames; ++i) {
    const auto &pair_left = left.frame(i), &pair_right = right.frame(i);
    found = filter.process({left.stamp(i), pair_left.pair().left, pair_right.pair().right}).rig;
  }
  return found;
}

TEST(Rig, AGoodOneIsFoundGood) {
  const RigConstants found = findRig(0.0, 0.0);
  EXPECT_LT(std::abs(found.roll_rad), 4.0 * found.roll_sigma_rad);
  EXPECT_LT(std::abs(found.delay_s), 4.0 * found.delay_sigma_s);
  EXPECT_LT(found.roll_sigma_rad, 0.5 * Parameters().right_roll * M_PI / 180.0);
  EXPECT_LT(found.delay_sigma_s, 2e-3);
}

TEST(Rig, ARolledCameraIsFound) {
  constexpr double kRoll = 0.2 * M_PI / 180.0;
  const RigConstants found = findRig(kRoll, 0.0);
  EXPECT_NEAR(found.roll_rad, kRoll, 0.1 * kRoll);
  EXPECT_LT(std::abs(found.roll_rad - kRoll), 5.0 * found.roll_sigma_rad);
}

// For one camera and room, so that other errors are equal.
TEST(Rig, DistinguishesALateShutterFromAnEarlyOne) {
  constexpr double kDelay = 4e-3;
  const RigConstants late = findRig(0.0, kDelay), early = findRig(0.0, -kDelay);
  EXPECT_NEAR(late.delay_s - early.delay_s, 2.0 * kDelay, 0.6 * kDelay);
  EXPECT_LT(std::abs(late.delay_s - kDelay), 4.0 * late.delay_sigma_s);
  EXPECT_LT(std::abs(early.delay_s + kDelay), 4.0 * early.delay_sigma_s);
}

}  // namespace
}  // namespace swf_vo
