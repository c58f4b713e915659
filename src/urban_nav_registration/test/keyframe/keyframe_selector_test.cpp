// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/keyframe/keyframe_selector.hpp"

#include <gtest/gtest.h>

namespace urban_nav_registration {
namespace {

using urban_nav_core::Pose;

Pose keyframePose(double x, double yaw = 0.0) {
  return Pose(urban_nav_core::expSo3(Eigen::Vector3d(0, 0, yaw)), Eigen::Vector3d(x, 0, 0));
}

class Choice : public ::testing::Test {
 protected:
  static Parameters parameters() {
    Parameters result;
    result.keyframe_distance = 1.0;
    result.keyframe_angle = 0.25;
    return result;
  }
  KeyframeSelector selector_{parameters()};
};

TEST_F(Choice, TheFirstViewIsKept) { EXPECT_TRUE(selector_.select(keyframePose(7.0))); }

TEST_F(Choice, DistanceIsMeasuredFromTheLastSelectedOne) {
  EXPECT_TRUE(selector_.select(keyframePose(0.0)));
  EXPECT_FALSE(selector_.select(keyframePose(0.6)));
  EXPECT_FALSE(selector_.select(keyframePose(0.99)));
  EXPECT_TRUE(selector_.select(keyframePose(1.0)));
  EXPECT_FALSE(selector_.select(keyframePose(1.9)));
  EXPECT_TRUE(selector_.select(keyframePose(2.1)));
}

TEST_F(Choice, ATurnOnTheSpotIsEnough) {
  EXPECT_TRUE(selector_.select(keyframePose(0.0)));
  EXPECT_FALSE(selector_.select(keyframePose(0.0, 0.24)));
  EXPECT_TRUE(selector_.select(keyframePose(0.0, -0.26)));
}

TEST_F(Choice, ResumesAfterAStoredKeyframe) {
  selector_.keep(keyframePose(5.0));
  EXPECT_FALSE(selector_.select(keyframePose(5.5)));
  EXPECT_TRUE(selector_.select(keyframePose(6.5)));
}

}  // namespace
}  // namespace urban_nav_registration
