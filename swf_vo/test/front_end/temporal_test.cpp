// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/temporal.hpp"

#include <gtest/gtest.h>

#include "front_end/across.hpp"
#include "front_end/refine.hpp"
#include "front_end/replenish.hpp"
#include "rendered.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::expSe3;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_core::Vector6d;
using namespace urban_nav_core::testing;

constexpr double kFloor = 0.05;

/// Landmarks started in frame 0 of a room, their true positions in the scene, and the corners of frame 1.
class TwoFrames : public ::testing::Test {
 protected:
  void SetUp() override {
    const Pose first = lookingAlong({0.2, 0.1, 1.2}, 0.3);
    Vector6d motion;
    motion << 0.03, -0.01, 0.12, 0.01, 0.02, 0.02;
    const Pose second = first * expSe3(motion);
    SequenceOptions options = smallCamera(2.0);
    RenderedSequence sequence(
        texturedRoom(), [&](double t) { return t > 0.0 ? second : first; }, options);
    camera_ = makeCamera(options.camera);
    T_camera_odom_ = second.inverse();
    corners_.extract(sequence.frame(0).pair());
    Replenisher replenisher(camera_, 60, kFloor);
    replenisher.replenish(0, corners_, first, {}, tracks_, fresh_, rows_);
    const Scene scene = texturedRoom();
    for (const Observation& o : fresh_) {
      const Track* track = tracks_.find(o.landmark);
      const auto hit = scene.trace(first.t(), first.q() * track->ray);
      if (!hit) continue;
      const double depth = hit->distance;
      if (std::abs(camera_.left.fx * camera_.baseline / depth - (o.z.x() - o.z.z())) > 0.5) continue;
      Match match;
      match.track = tracks_.find(o.landmark);
      match.p_odom << first * Eigen::Vector3d(depth * track->ray), 1.0;
      matches_.push_back(match);
    }
    corners_.extract(sequence.frame(1).pair());
  }

  /// Returns the distance of a measurement from the true projection of the landmark.
  double error(Side side, const Match& match) const {
    const PixelMeasurement& sighting = side == Side::Left ? match.left : match.right;
    return (sighting.pixel - *projectInto(side, camera_, T_camera_odom_, match.p_odom)).norm();
  }

  StereoCamera camera_;
  Corners corners_{3, 2, 12, 60};
  Tracks tracks_{200};
  RowOffset rows_{400};
  std::vector<Observation> fresh_;
  std::vector<Match> matches_;
  Pose T_camera_odom_;
};

TEST_F(TwoFrames, CornersAreFoundFromACrudePrediction) {
  ASSERT_GT(matches_.size(), 25U);
  Vector6d wrong;
  wrong << 0.02, 0.0, 0.05, 0.0, 0.03, 0.0;
  matchTemporal(corners_, camera_, expSe3(wrong) * T_camera_odom_, 16.0, matches_);
  int good = 0, left = 0, right = 0;
  for (const Match& match : matches_) {
    EXPECT_FALSE(match.left.found && match.right.found);
    left += match.left.found;
    right += match.right.found;
    if (match.left.found && error(Side::Left, match) < 0.5) ++good;
    if (match.right.found && error(Side::Right, match) < 0.5) ++good;
  }
  EXPECT_GT(left, 5);
  EXPECT_GT(right, 5);
  EXPECT_GT(good, 0.6 * static_cast<double>(matches_.size()));
}

TEST_F(TwoFrames, WhatIsUniqueIsFoundFromFarAway) {
  Vector6d wrong;
  wrong << 0.0, 0.0, 0.0, 0.1, 0.2, 0.0;  // 56 px
  matchAnywhere(corners_, camera_, expSe3(wrong) * T_camera_odom_, 80.0, matches_);
  int good = 0, found = 0;
  for (const Match& match : matches_) {
    EXPECT_FALSE(match.left.found && match.right.found);
    found += match.left.found || match.right.found;
    if (match.left.found && error(Side::Left, match) < 0.5) ++good;
    if (match.right.found && error(Side::Right, match) < 0.5) ++good;
  }
  EXPECT_GT(good, 0.4 * static_cast<double>(matches_.size()));
  EXPECT_GT(good, 0.7 * found);
}

TEST_F(TwoFrames, BothImagesAreMeasuredToATenthOfAPixel) {
  matchTemporal(corners_, camera_, T_camera_odom_, 8.0, matches_);
  matchAcross(corners_, camera_, T_camera_odom_, matches_);
  int both = 0, close = 0;
  for (Match& match : matches_) {
    combine(kFloor, match);
    if (!match.measured || !match.left.found || !match.right.found) continue;
    ++both;
    if (error(Side::Left, match) < 0.25 && error(Side::Right, match) < 0.25) ++close;
  }
  EXPECT_GT(both, 0.75 * static_cast<double>(matches_.size()));
  EXPECT_GT(close, 0.85 * both);
}

TEST_F(TwoFrames, NothingIsFoundWhereTheLandmarksAreNot) {
  Vector6d away;
  away << 0.0, 0.0, 0.0, 0.0, 3.0, 0.0;
  matchTemporal(corners_, camera_, expSe3(away) * T_camera_odom_, 16.0, matches_);
  for (const Match& match : matches_) EXPECT_FALSE(match.left.found || match.right.found);
}

TEST(ProjectInto, AgreesWithTheCameraAlsoAtInfinity) {
  const StereoCamera camera = makeCamera(smallCamera().camera);
  const Eigen::Vector3d p(0.5, -0.2, 4.0);
  const auto z = camera.project(p);
  const Eigen::Vector4d h(0.5, -0.2, 4.0, 1.0);
  EXPECT_NEAR(projectInto(Side::Left, camera, Pose(), h)->x(), z->x(), 1e-12);
  EXPECT_NEAR(projectInto(Side::Right, camera, Pose(), 2.0 * h)->x(), z->z(), 1e-12);
  EXPECT_FALSE(projectInto(Side::Left, camera, Pose(), {0.0, 0.0, -1.0, 1.0}));
  const auto far_left = projectInto(Side::Left, camera, Pose(), {0.1, 0.1, 1.0, 0.0});
  EXPECT_NEAR(far_left->x(), projectInto(Side::Right, camera, Pose(), {0.1, 0.1, 1.0, 0.0})->x(), 1e-12);
}

}  // namespace
}  // namespace swf_vo
