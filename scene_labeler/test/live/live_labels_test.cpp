// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_labels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/yard.hpp"

namespace scene_labeler {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;

constexpr int kPoses = 60;  // of 0.1 s and 0.1 m

StampNs toStamp(int pose) { return 100'000'000LL * (pose + 1); }

/// A wall 4 m to the left of a laser, and the ground 1 m below it.
urban_nav_core::PlanarScan scanWall(StampNs stamp) {
  urban_nav_core::PlanarScan scan;
  scan.stamp = stamp;
  scan.angle_first = -1.0;
  scan.angle_step = 0.02;
  scan.range_max = 30.0;
  for (int beam = 0; beam < 80; ++beam) {
    const double angle = scan.angle_first + scan.angle_step * beam;
    const double wall = 4.0 / std::cos(angle);
    scan.ranges.push_back(static_cast<float>(angle < 0.0 ? std::min(wall, -1.0 / std::sin(angle)) : wall));
    scan.intensities.push_back(60.0F);
  }
  return scan;
}

class LiveLabelsOfAWall : public ::testing::Test {
 protected:
  LiveLabelsOfAWall() {
    parameters_.spacing = 1.0;
    parameters_.projection_distance = 1.5;
    Eigen::Matrix3d R_laser;
    R_laser << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // to the left, upright
    labels_ = std::make_unique<LiveLabels>(
        parameters_, testing::trainOnYards(ClassifierKind::Boosted),
        LiveLabels::Outputs{[this](const auto& returns, const SceneLabels&) { labelled_ += returns.size(); },
                            [](std::size_t, const DriveFrame&, const cv::Mat&) {}});
    labels_->setLaser(0, Pose(R_laser, Vector3d(0.0, 0.2, 1.0)));
  }
  void addPose(int i) {
    labels_->addPose({toStamp(i), Pose(Eigen::Matrix3d::Identity(), Vector3d(0.1 * i, 0.0, 0.0))});
  }
  void addScan(int i) { labels_->addScan(0, scanWall(toStamp(i))); }

  Parameters parameters_;
  std::size_t labelled_ = 0;
  std::unique_ptr<LiveLabels> labels_;
};

TEST_F(LiveLabelsOfAWall, ScansThatComeAfterTheLastPoseAreLabelledWithoutAnotherOne) {
  for (int i = 0; i < kPoses; ++i) {
    addScan(i);
    addPose(i);
  }
  const std::size_t in_order = labelled_;
  ASSERT_GT(in_order, 0U);

  labels_->reset();
  labelled_ = 0;
  labels_->catchUp();
  for (int i = 0; i < kPoses; ++i) addPose(i);
  for (int i = 0; i < kPoses; ++i) addScan(i);
  EXPECT_EQ(labelled_, 0U);
  labels_->catchUp();
  EXPECT_EQ(labelled_, in_order);
  labels_->catchUp();
  EXPECT_EQ(labelled_, in_order) << "each is labelled once";
}

TEST_F(LiveLabelsOfAWall, EachRoundOfARecordingHasTheSameLabels) {
  const auto drive = [this] {
    const std::size_t before = labelled_;
    for (int i = 0; i < kPoses; ++i) {
      addScan(i);
      addPose(i);
    }
    return labelled_ - before;
  };
  const std::size_t first = drive();
  ASSERT_GT(first, 0U);
  // Scans of the next round arrive before its odometry, and those of the previous round after it.
  addScan(0);
  EXPECT_EQ(labelled_, first);
  const std::size_t second = drive();
  addScan(kPoses - 1);
  const std::size_t third = drive();
  EXPECT_EQ(labels_->counts().drives, 2U);
  EXPECT_GE(second, first) << "including unfinished returns of the previous drive";
  EXPECT_NEAR(static_cast<double>(third), static_cast<double>(second), 0.2 * static_cast<double>(second));
}

}  // namespace
}  // namespace scene_labeler
