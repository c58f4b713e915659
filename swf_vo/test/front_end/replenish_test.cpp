// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/replenish.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

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
    camera_ = makeCamera(sequence.options().camera);
    frame_ = sequence.frame(0);
    corners_.extract(frame_.pair());
  }

  // Multiplies the exposure time.
  void expose(double times) {
    for (GreyImage* image : {&frame_.left, &frame_.right})
      for (std::uint8_t& pixel : image->pixels)
        pixel = static_cast<std::uint8_t>(std::min(255.0, std::round(times * pixel)));
    corners_.extract(frame_.pair());
  }

  // Returns whether an observation is within `reach` px of a white pixel in the left image.
  bool isNearWhite(const Observation& observation, int reach) const {
    const int u = static_cast<int>(std::lround(observation.z.x())),
              v = static_cast<int>(std::lround(observation.z.y()));
    for (int j = v - reach; j <= v + reach; ++j)
      for (int i = u - reach; i <= u + reach; ++i)
        if (frame_.left.view().at(i, j) == 255) return true;
    return false;
  }

  StereoFrame frame_;

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

TEST_F(Replenish, TakesNoCornerOfWhatIsClipped) {
  expose(1.4);
  const auto& pixels = frame_.left.pixels;
  const auto white = std::count(pixels.begin(), pixels.end(), 255);
  ASSERT_GT(white, static_cast<std::ptrdiff_t>(pixels.size() / 50));
  ASSERT_LT(white, static_cast<std::ptrdiff_t>(pixels.size() / 3));
  Replenisher replenisher(camera_, 50, 0.05);
  replenisher.replenish(0, corners_, Pose(), {}, tracks_, fresh_, rows_);
  EXPECT_GT(fresh_.size(), 25U);
  for (const Observation& o : fresh_) EXPECT_FALSE(isNearWhite(o, 1)) << o.z.transpose();
}

TEST_F(Replenish, TakesThemWhereThereIsLittleElse) {
  expose(3.0);
  Replenisher replenisher(camera_, 50, 0.05);
  replenisher.replenish(0, corners_, Pose(), {}, tracks_, fresh_, rows_);
  EXPECT_GT(fresh_.size(), 10U);
  EXPECT_GT(std::count_if(fresh_.begin(), fresh_.end(), [&](const auto& o) { return isNearWhite(o, 2); }), 0);
}

TEST_F(Replenish, StopsWhereThereIsNoPlaceForTracks) {
  Tracks few(5);
  Replenisher replenisher(camera_, 50, 0.05);
  replenisher.replenish(0, corners_, Pose(), {}, few, fresh_, rows_);
  EXPECT_EQ(fresh_.size(), 5U);
}

}  // namespace
}  // namespace swf_vo
