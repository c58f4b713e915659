// SPDX-License-Identifier: BSD-3-Clause
#include "swf_vo/propagation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "live/live_odometry.hpp"
#include "recordings.hpp"
#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::MotionInput;
using urban_nav_core::MotionSource;
using urban_nav_core::Pose;
using urban_nav_core::secondsBetween;
using urban_nav_core::StampNs;
using urban_nav_core::StereoPairWithMotion;

constexpr StampNs kRatePeriod = 5'000'000;  // ns: 200 Hz
constexpr double kRateSigma = 1e-3;         // rad/s

/// A robot whose base_link is its left camera, with a gyroscope. It swings about all axes.
class SwingingRobot {
 public:
  SwingingRobot() : room_(inTheRoom("wander", 1.0, kFrames)) {}
  static constexpr int kFrames = 60;

  const Recording& room() const { return room_; }
  /// Returns the pose relative to the first frame.
  Pose at(StampNs stamp) const { return seen(begin()).inverse() * seen(stamp); }
  StampNs begin() const { return room_.frames.front().stamp; }

  std::vector<MotionInput> rates(StampNs from, StampNs to) const {
    std::vector<MotionInput> inputs;
    for (StampNs end = from + kRatePeriod; end <= to; end += kRatePeriod) {
      MotionInput input;
      input.source = MotionSource::Gyroscope;
      input.from = end - kRatePeriod;
      input.to = end;
      input.T_from_to = Pose((seen(input.from).inverse() * seen(end)).q(), Eigen::Vector3d::Zero());
      const double sigma = kRateSigma * secondsBetween(input.from, end);
      input.information.diagonal().tail<3>().setConstant(1.0 / (sigma * sigma));
      inputs.push_back(input);
    }
    return inputs;
  }
  /// Returns a filter that has processed this number of frames with their rates.
  SwfVo drive(int frames) const {
    SwfVo filter(Parameters(), room_.camera, Pose());
    for (int i = 0; i < frames; ++i) filter.process(room_.frames[index(i)].pair(), ratesBefore(i));
    return filter;
  }
  std::vector<MotionInput> ratesBefore(int i) const {
    return i == 0 ? std::vector<MotionInput>() : rates(stamp(i - 1), stamp(i));
  }
  StampNs stamp(int i) const { return room_.frames[index(i)].stamp; }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  Pose seen(StampNs stamp) const { return motion_(secondsBetween(begin(), stamp)); }

  const Recording& room_;
  urban_nav_core::testing::Motion motion_ = urban_nav_core::testing::namedMotion("wander", "room", 1);
};

TEST(Propagation, ThePoseFollowsTheGyroscopeWithAGrowingCovariance) {
  const SwingingRobot robot;
  const SwfVo filter = robot.drive(SwingingRobot::kFrames);
  Propagation propagation = filter.propagation();
  const StampNs newest = robot.stamp(SwingingRobot::kFrames - 1);
  const std::vector<MotionInput> rates = robot.rates(newest, newest + 20 * kRatePeriod);
  ASSERT_EQ(rates.size(), 20U);
  double before = 0.0, turned = 0.0;
  for (const MotionInput& rate : rates) {
    const std::optional<PropagatedPose> pose = propagation.add(rate);
    ASSERT_TRUE(pose);
    // The estimated delay of the rates, which have none, shifts the stamp.
    EXPECT_NEAR(secondsBetween(rate.to, pose->stamp), 0.0, 3e-3);
    const Pose truth = robot.at(pose->stamp);
    const Pose last = robot.at(newest);
    turned = urban_nav_core::angleBetween(last, truth);
    EXPECT_LT(urban_nav_core::angleBetween(pose->T_odom_base.pose, truth), 2e-3) << turned;
    const double trace = pose->T_odom_base.covariance.trace();
    EXPECT_GT(trace, before);
    before = trace;
    EXPECT_LT(urban_nav_core::nees(truth, pose->T_odom_base).value(), 22.5) << "99.9 %";
    const Eigen::Vector3d rate_true =
        urban_nav_core::logSo3(robot.at(rate.from).q().conjugate() * robot.at(rate.to).q()) / 5e-3;
    EXPECT_LT((pose->velocity.twist.tail<3>() - rate_true).norm(), 0.02);
    EXPECT_LT(pose->velocity.covariance.diagonal().tail<3>().maxCoeff(), 0.02 * 0.02);
  }
  EXPECT_GT(turned, 0.01) << "the robot does turn, by more than the tolerance";
}

TEST(Propagation, WithoutFramesThePoseContinuesAndItsCovarianceGrows) {
  const SwingingRobot robot;
  Propagation propagation = robot.drive(SwingingRobot::kFrames).propagation();
  const StampNs newest = robot.stamp(SwingingRobot::kFrames - 1);
  double before = 0.0;
  for (const MotionInput& rate : robot.rates(newest, newest + 700 * kRatePeriod)) {
    const std::optional<PropagatedPose> pose = propagation.add(rate);
    ASSERT_TRUE(pose);
    EXPECT_LT(urban_nav_core::angleBetween(pose->T_odom_base.pose, robot.at(pose->stamp)), 0.01);
    EXPECT_GE(pose->T_odom_base.covariance.trace(), before) << secondsBetween(newest, pose->stamp) << " s";
    before = pose->T_odom_base.covariance.trace();
  }
}

TEST(Propagation, RequiresAGyroscopeInUseAndLaterInputs) {
  const SwingingRobot robot;
  const auto next = [&](int frame) {
    return robot.rates(robot.stamp(frame), robot.stamp(frame) + kRatePeriod).front();
  };
  EXPECT_FALSE(robot.drive(4).propagation().add(next(3))) << "not confirmed by images yet";
  const SwfVo filter = robot.drive(SwingingRobot::kFrames);
  EXPECT_FALSE(filter.propagation().add(next(SwingingRobot::kFrames - 3))) << "the newest frame is later";
  MotionInput wheels = next(SwingingRobot::kFrames - 1);
  wheels.source = MotionSource::Wheels;
  EXPECT_FALSE(filter.propagation().add(wheels));
  EXPECT_TRUE(filter.propagation().add(next(SwingingRobot::kFrames - 1)));
}

TEST(Propagation, LeavesTheFilterAsItIs) {
  const SwingingRobot robot;
  const SwfVo filter = robot.drive(40);
  const std::string before = filter.state();
  Propagation propagation = filter.propagation();
  const StampNs newest = robot.stamp(39);
  for (const MotionInput& rate : robot.rates(newest, newest + 10 * kRatePeriod)) propagation.add(rate);
  EXPECT_EQ(filter.state(), before);
}

/// Plays the robot to a live stage: each rate as it arrives, each pair some rates late. Returns its frames.
std::vector<Frame> playLive(const SwingingRobot& robot, std::vector<PropagatedPose>* between) {
  std::vector<Frame> frames;
  LiveOdometry::Listener listener;
  listener.frame = [&](const Frame& frame, const urban_nav_core::StereoPair&, double) { frames.push_back(frame); };
  if (between != nullptr) listener.propagated = [between](const PropagatedPose& pose) { between->push_back(pose); };
  LiveOdometry live(Parameters(), listener);
  live.begin(robot.room().camera, Pose());
  constexpr StampNs kLate = 4 * kRatePeriod;
  StampNs measured = robot.begin();
  for (int i = 0; i < SwingingRobot::kFrames; ++i) {
    for (const MotionInput& rate : robot.rates(measured, robot.stamp(i) + kLate)) live.addMotion(rate);
    measured = std::max(measured, robot.stamp(i) + kLate);
    StereoPairWithMotion pair;
    pair.pair = robot.room().frames[static_cast<std::size_t>(i)].pair();
    pair.inputs = robot.ratesBefore(i);
    live.process(pair);
  }
  live.end(LiveOdometry::kFinished);
  return frames;
}

TEST(Propagation, LiveFramesAreTheSameAndPosesBetweenThemAreInOrder) {
  const SwingingRobot robot;
  std::vector<PropagatedPose> between;
  const std::vector<Frame> with = playLive(robot, &between), without = playLive(robot, nullptr);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(with[i].T_odom_base.pose.t(), without[i].T_odom_base.pose.t());
    EXPECT_EQ(with[i].T_odom_base.pose.q().coeffs(), without[i].T_odom_base.pose.q().coeffs());
    EXPECT_EQ(with[i].T_odom_base.covariance, without[i].T_odom_base.covariance);
  }
  ASSERT_GT(between.size(), 150U) << "ten a frame after the first second";
  for (std::size_t i = 0; i < between.size(); ++i) {
    if (i > 0) {
      EXPECT_GT(between[i].stamp, between[i - 1].stamp);
    }
    EXPECT_LT(urban_nav_core::distanceBetween(between[i].T_odom_base.pose, robot.at(between[i].stamp)), 0.02);
  }
}

}  // namespace
}  // namespace swf_vo
