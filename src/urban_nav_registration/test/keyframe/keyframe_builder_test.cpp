// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/keyframe/keyframe_builder.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/textured_street.hpp"
#include "urban_nav_registration/testing/photographer.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampedPose;
using urban_nav_core::StampNs;
using urban_nav_core::StereoPairWithMotion;

/// A drive along x with a pair every 0.6 m; keyframes are selected every metre.
class KeyframeBuilderTest : public ::testing::Test {
 protected:
  KeyframeBuilderTest() : builder_(Parameters()) { builder_.setCamera({photographer_.camera(), Pose()}); }

  static Pose poseAt(StampNs stamp) {
    return Pose(urban_nav_core::Quaterniond::Identity(), {0.6 * static_cast<double>(stamp), 0.0, 0.0});
  }
  void addPair(StampNs stamp) {
    frames_.push_back(photographer_.take(Pose()));
    StereoPairWithMotion pair;
    pair.pair = frames_.back().pair();
    pair.pair.stamp = stamp;
    builder_.addPair(std::move(pair));
  }
  void addOdometry(StampNs stamp) { builder_.addOdometry(StampedPose{stamp, poseAt(stamp)}); }
  std::vector<StampNs> taken() {
    std::vector<StampNs> stamps;
    for (const Keyframe& keyframe : builder_.take()) stamps.push_back(keyframe.at.stamp);
    return stamps;
  }

  testing::Photographer photographer_{urban_nav_core::testing::texturedStreet()};
  std::deque<urban_nav_core::testing::StereoFrame> frames_;
  KeyframeBuilder builder_;
};

TEST_F(KeyframeBuilderTest, PairsWaitForOdometryAndAreSelectedAlongIt) {
  for (StampNs stamp = 1; stamp <= 5; ++stamp) addPair(stamp);
  EXPECT_TRUE(taken().empty());
  for (StampNs stamp = 1; stamp <= 5; ++stamp) addOdometry(stamp);
  EXPECT_EQ(taken(), (std::vector<StampNs>{1, 3, 5}));
  EXPECT_EQ(builder_.counts().pairs, 5);
  EXPECT_EQ(builder_.counts().extracted, 3);
  EXPECT_EQ(builder_.counts().without_odometry, 0);
}

TEST_F(KeyframeBuilderTest, OdometryMayArriveFirst) {
  for (StampNs stamp = 1; stamp <= 3; ++stamp) addOdometry(stamp);
  for (StampNs stamp = 1; stamp <= 3; ++stamp) addPair(stamp);
  EXPECT_EQ(taken(), (std::vector<StampNs>{1, 3}));
}

TEST_F(KeyframeBuilderTest, PairsWithoutOdometryAreCountedAndSkipped) {
  for (const StampNs stamp : {1, 2, 3}) addPair(stamp);
  for (const StampNs stamp : {1, 3}) addOdometry(stamp);
  EXPECT_EQ(taken(), (std::vector<StampNs>{1, 3}));
  EXPECT_EQ(builder_.counts().without_odometry, 1);
}

TEST_F(KeyframeBuilderTest, RepeatedPosesAreIgnored) {
  addOdometry(2);
  addOdometry(2);
  addOdometry(1);
  addPair(1);
  addPair(2);
  EXPECT_EQ(taken(), (std::vector<StampNs>{2}));
}

TEST_F(KeyframeBuilderTest, WaitingPairsAreBounded) {
  for (StampNs stamp = 1; stamp <= 120; ++stamp) {
    StereoPairWithMotion pair;
    pair.pair.stamp = stamp;
    builder_.addPair(std::move(pair));
  }
  EXPECT_EQ(builder_.counts().without_odometry, 20);
}

TEST_F(KeyframeBuilderTest, ARestartSelectsTheFirstPairAgain) {
  addPair(1);
  addOdometry(1);
  EXPECT_EQ(taken(), (std::vector<StampNs>{1}));
  addPair(2);
  builder_.restart();
  addOdometry(1);
  addPair(1);
  EXPECT_EQ(taken(), (std::vector<StampNs>{1})) << "the waiting pair is dropped, the selection restarts";
}

TEST_F(KeyframeBuilderTest, ClearingTheCameraDropsItsPairs) {
  addPair(1);
  builder_.clearCamera();
  EXPECT_FALSE(builder_.camera());
  addOdometry(1);
  EXPECT_TRUE(taken().empty());
}

}  // namespace
}  // namespace urban_nav_registration
