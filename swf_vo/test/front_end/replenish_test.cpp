// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/replenish.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "rendered.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using namespace urban_nav_core::testing;

class Replenish : public ::testing::Test {
 protected:
  void SetUp() override {
    RenderedSequence sequence(texturedRoom(), standing(lookingAlong({0.0, 0.0, 1.2}, 0.3)), smallCamera(1.0));
    camera_ = cameraOf(sequence.options().camera);
    corners_.extract(sequence.frame(0).pair());
  }

  StereoCamera camera_;
  Corners corners_{3, 2, 12, 50};
  Tracks tracks_{200};
  RowOffset rows_{400};
  std::vector<Observation> fresh_;
};

TEST_F(Replenish, StartsNoMoreThanWantedAndSpreadsThem) {
  Replenisher replenisher(camera_, 50, 0.05);
  replenisher.replenish(7, corners_, Pose(), {}, tracks_, fresh_, rows_);
  EXPECT_LE(fresh_.size(), 50U);
  EXPECT_GT(fresh_.size(), 25U);
  EXPECT_EQ(tracks_.size(), static_cast<int>(fresh_.size()));
  int quarters[4] = {};
  for (const Observation& o : fresh_) {
    EXPECT_EQ(o.frame, 7);
    ++quarters[(o.z.x() > 160 ? 1 : 0) + (o.z.y() > 120 ? 2 : 0)];
    const Track* track = tracks_.find(o.landmark);
    ASSERT_NE(track, nullptr);
    EXPECT_EQ(track->born, 7);
    EXPECT_GT(track->sigma_disparity, 0.0);
    EXPECT_GT(o.information.determinant(), 0.0);
  }
  for (const int quarter : quarters) EXPECT_LE(quarter, 25);
}

TEST_F(Replenish, WhatIsFollowedKeepsItsPlace) {
  Replenisher replenisher(camera_, 50, 0.05);
  replenisher.replenish(0, corners_, Pose(), {}, tracks_, fresh_, rows_);
  std::vector<Match> matches;
  for (const Observation& o : fresh_) {
    Match match;
    match.track = tracks_.find(o.landmark);
    match.inlier = match.left.found = true;
    match.left.pixel = o.z.head<2>();
    matches.push_back(match);
  }
  const std::size_t before = fresh_.size();
  fresh_.clear();
  replenisher.replenish(1, corners_, Pose(), matches, tracks_, fresh_, rows_);
  EXPECT_LE(fresh_.size() + before, 50U);
  for (const Observation& o : fresh_)
    for (const Match& match : matches) EXPECT_GT((o.z.head<2>() - match.left.pixel).norm(), 1.0);
}

TEST_F(Replenish, StopsWhereThereIsNoPlaceForTracks) {
  Tracks few(5);
  Replenisher replenisher(camera_, 50, 0.05);
  replenisher.replenish(0, corners_, Pose(), {}, few, fresh_, rows_);
  EXPECT_EQ(fresh_.size(), 5U);
}

}  // namespace
}  // namespace swf_vo
