// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_sweeps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/yard.hpp"

namespace scene_labeler {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

constexpr StampNs kSweepPeriod = 100'000'000;
constexpr double kStep = 0.2;  // m per sweep, along x

StampNs sweepStamp(int sweep) { return 1'000'000'000 + sweep * kSweepPeriod; }

/// A robot that drives along x through a yard, with a LiDAR 1 m above the ground that sees every fifth point.
class LiveSweepsInAYard : public ::testing::Test {
 protected:
  LiveSweepsInAYard()
      : sweeps_(T_odom_base_, [this](StampNs reference, const auto& returns, const SweepLabels& labels) {
          references_.push_back(reference);
          for (std::size_t i = 0; i < returns.size(); ++i)
            if (labels.answer_of_return[i] != SweepLabels::kNoAnswer) ground_z_ += std::abs(returns[i].p.z()) < 0.1F;
        }) {
    sweeps_.place("lidar", Pose(Eigen::Matrix3d::Identity(), Vector3d(0.0, 0.0, 1.0)));
  }
  void addPose(int sweep) {
    T_odom_base_.append(sweepStamp(sweep), Pose(Eigen::Matrix3d::Identity(), Vector3d(kStep * sweep, 0.0, 0.0)));
  }
  /// The sweep around a stamp: beams of its first half, then of its second.
  urban_nav_core::Sweep sweep(int number) const {
    urban_nav_core::Sweep sweep;
    sweep.reference = sweepStamp(number);
    sweep.times = urban_nav_core::Sweep::Times::Measured;
    const std::vector<Eigen::Vector3f>& points = yard_.scene.points;
    for (std::size_t i = 0; i < points.size(); i += 5) {
      urban_nav_core::Beam beam;
      const double share = static_cast<double>(i) / static_cast<double>(points.size()) - 0.5;
      beam.stamp = sweep.reference + static_cast<StampNs>(share * 0.9 * kSweepPeriod);
      const double x = kStep * (number + 0.9 * share);
      const Eigen::Vector3f p = points[i] - Eigen::Vector3f(static_cast<float>(x), 0.0F, 1.0F);
      beam.range = p.norm();
      beam.direction = p / beam.range;
      sweep.beams.push_back(beam);
    }
    return sweep;
  }
  bool labelNext() { return sweeps_.labelNext(model_, 12); }

  const testing::Yard yard_ = testing::makeYard(61);
  const std::shared_ptr<const LabelModel> model_ =
      std::make_shared<const LabelModel>(testing::trainOnYards(ClassifierKind::Boosted));
  urban_nav_core::Trajectory T_odom_base_;
  std::vector<StampNs> references_;
  std::size_t ground_z_ = 0;
  LiveSweeps sweeps_;
};

TEST_F(LiveSweepsInAYard, WaitForTheOdometryOfTheirLastBeam) {
  addPose(-1);
  addPose(0);
  sweeps_.add("lidar", sweep(0));
  EXPECT_FALSE(labelNext()) << "its second half is not covered";
  addPose(1);
  EXPECT_TRUE(labelNext());
  EXPECT_FALSE(labelNext());
  EXPECT_EQ(references_, std::vector<StampNs>{sweepStamp(0)});
  EXPECT_GT(ground_z_, 600U) << "each beam with the pose of its time: the ground is at z = 0";
  EXPECT_EQ(sweeps_.counts().labelled, 1U);
  EXPECT_TRUE(sweeps_.fault().empty());
}

TEST_F(LiveSweepsInAYard, AreDroppedOldestFirstIfTheyComeFasterThanTheyAreLabelled) {
  for (int i = -1; i <= 20; ++i) addPose(i);
  const auto addAndLabel = [&](int first, int end) {
    for (int i = first; i < end; ++i) sweeps_.add("lidar", sweep(i));
    while (labelNext()) {
    }
  };
  addAndLabel(0, 8);
  EXPECT_EQ(references_, (std::vector<StampNs>{sweepStamp(5), sweepStamp(6), sweepStamp(7)})) << "labels are current";
  EXPECT_EQ(sweeps_.counts().too_many, 5U);
  EXPECT_TRUE(sweeps_.fault().empty()) << "the first ones come at once";
  addAndLabel(8, 18);
  EXPECT_EQ(references_.back(), sweepStamp(17));
  EXPECT_EQ(sweeps_.counts().sweeps, 18U);
  EXPECT_EQ(sweeps_.counts().labelled, 6U);
  EXPECT_EQ(sweeps_.counts().too_many, 12U);
  EXPECT_NE(sweeps_.fault().find("7 of the last 13 sweeps"), std::string::npos) << sweeps_.fault();
  for (int round = 0; round < 60; ++round) {
    sweeps_.add("lidar", sweep(10));
    ASSERT_TRUE(labelNext());
  }
  EXPECT_TRUE(sweeps_.fault().empty()) << "it keeps up again";
}

TEST_F(LiveSweepsInAYard, AreDroppedWithoutOdometryAndForgottenWithTheDrive) {
  for (int i = 0; i < 60; ++i) sweeps_.add("lidar", sweep(i));
  EXPECT_EQ(sweeps_.counts().unplaced, 10U) << "50 wait";
  EXPECT_EQ(sweeps_.counts().too_many, 0U);
  sweeps_.clear();
  for (int i = -1; i <= 60; ++i) addPose(i);
  EXPECT_FALSE(labelNext());
  EXPECT_TRUE(sweeps_.isPlaced("lidar"));
}

}  // namespace
}  // namespace scene_labeler
