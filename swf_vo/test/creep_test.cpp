// SPDX-License-Identifier: BSD-3-Clause
// A robot at rest that starts to move at 2 cm/s, a millimetre per frame: the first five centimetres are measured
// without loss or jump.
#include <gtest/gtest.h>

#include <algorithm>

#include "recordings.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::testing::lookingAlong;
using urban_nav_core::testing::Motion;
using urban_nav_core::testing::RoomSize;

constexpr int kStandingFrames = 10, kCreepingFrames = 50;  // frames at 20 Hz
constexpr double kSpeed = 0.02;                            // m/s

struct Start {
  const char* name;
  Vector3d direction;  ///< in the camera: x right, z forward
  double yaw;          ///< yaw of the camera in the room, rad
  double noise;        ///< grey levels
};
void PrintTo(const Start& start, std::ostream* out) { *out << start.name << ", noise " << start.noise; }

class Creep : public ::testing::TestWithParam<Start> {};

TEST_P(Creep, TheFirstFiveCentimetresAreRightToATenth) {
  const Start& start = GetParam();
  const Pose first = lookingAlong({-RoomSize().freeX(), 0.3, 1.1}, start.yaw);
  const Motion motion = [&](double t) {
    const double way = kSpeed * std::max(0.0, t - kStandingFrames / 20.0);
    return first * Pose(Eigen::Quaterniond::Identity(), way * start.direction);
  };
  const Recording room = inTheRoom(motion, start.noise, kStandingFrames + kCreepingFrames + 1);
  SwfVo filter(Parameters(), room.camera, Pose());
  double last = 0.0;
  Vector3d stood = Vector3d::Zero(), went = Vector3d::Zero();
  for (int i = 0; i <= kStandingFrames + kCreepingFrames; ++i) {
    const Pose now = filter.process(room.frames[static_cast<std::size_t>(i)].pair()).T_odom_base.pose;
    if (i == kStandingFrames) stood = now.t();
    went = now.t() - stood;
    if (i > kStandingFrames) {
      EXPECT_NEAR(went.dot(start.direction) - last, 0.001, 0.002) << "a jump at " << i;
    }
    last = went.dot(start.direction);
  }
  EXPECT_NEAR(last, 0.05, 0.005);
  EXPECT_LT((went - 0.05 * start.direction).norm(), 0.005);
}

INSTANTIATE_TEST_SUITE_P(Each, Creep,
                         ::testing::Values(Start{"forward", Vector3d::UnitZ(), 0.0, 1.0},
                                           Start{"sideways", Vector3d::UnitX(), 0.4, 2.0},
                                           Start{"backward, slantwise", Vector3d(0.6, 0.0, -0.8), -0.5, 3.0}));

}  // namespace
}  // namespace swf_vo
