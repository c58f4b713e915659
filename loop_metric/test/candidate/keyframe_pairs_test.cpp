// SPDX-License-Identifier: BSD-3-Clause
#include "candidate/keyframe_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace loop_metric {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;

/// Keyframes at each metre along x, from `before` m before the pose to `after` m after it.
std::vector<NearbyKeyframe> row(const char* session, int before, int after) {
  std::vector<NearbyKeyframe> views;
  for (int i = -before; i <= after; ++i) {
    NearbyKeyframe view;
    view.at = {session, 1000 + i};
    view.T_place_keyframe.pose = Pose(urban_nav_core::Quaterniond::Identity(), {static_cast<double>(i), 0.0, 0.0});
    view.T_place_keyframe.covariance.setZero();
    view.path_offset = i;
    views.push_back(view);
  }
  return views;
}

PoseWithCovariance odometry(double x, double heading, double sigma_m, double sigma_rad) {
  PoseWithCovariance T_a_b;
  T_a_b.pose = Pose(urban_nav_core::expSo3({0.0, 0.0, heading}), {x, 0.0, 0.0});
  T_a_b.covariance.setZero();
  T_a_b.covariance.diagonal() << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  return T_a_b;
}

TEST(ViewPairs, AKeyframeNearBothMomentsIsNotMatchedWithItself) {
  // Back and forth within seven metres: the same keyframes are near both poses.
  auto back = row("a", 6, 6);
  for (NearbyKeyframe& view : back)
    view.T_place_keyframe.pose = Pose(urban_nav_core::Quaterniond::Identity(), {view.path_offset + 0.3, 0.0, 0.0});
  for (const auto& T_a_b :
       {std::optional<PoseWithCovariance>(odometry(0.0, 0.0, 0.01, 0.001)), std::optional<PoseWithCovariance>()}) {
    const auto pairs = chooseKeyframePairs(row("a", 6, 6), back, T_a_b, 6.0, 5);
    EXPECT_FALSE(pairs.empty());
    for (const KeyframePair& pair : pairs) EXPECT_FALSE(pair.a.at == pair.b.at);
  }
}

TEST(ViewPairs, WithoutOdometryTheViewsNearestToTheMomentsComeFirst) {
  const auto pairs = chooseKeyframePairs(row("a", 6, 6), row("b", 6, 6), std::nullopt, 6.0, 5);
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].a.at.stamp, 1000);
  EXPECT_EQ(pairs[0].b.at.stamp, 1000);
  EXPECT_EQ(pairs[1].a.at.stamp, 997);
  EXPECT_EQ(pairs[2].a.at.stamp, 1003);
}

TEST(ViewPairs, WhatOdometryPutsNearestComesFirst) {
  const auto pairs = chooseKeyframePairs(row("a", 6, 6), row("b", 6, 6), odometry(5.0, 0.0, 0.1, 0.01), 6.0, 5);
  ASSERT_FALSE(pairs.empty());
  const Pose T = pairs[0].a.T_place_keyframe.pose.inverse() * odometry(5.0, 0.0, 0.1, 0.01).pose *
                 pairs[0].b.T_place_keyframe.pose;
  EXPECT_LT(T.t().norm(), 1e-9);
}

TEST(ViewPairs, VagueOdometryDoesNotChooseThePlace) {
  const auto pairs = chooseKeyframePairs(row("a", 6, 6), row("b", 6, 6), odometry(5.0, 0.0, 3.0, 0.01), 6.0, 5);
  ASSERT_FALSE(pairs.empty());
  EXPECT_EQ(pairs[0].a.at.stamp, 1000);
  EXPECT_EQ(pairs[0].b.at.stamp, 1000);
}

TEST(ViewPairs, OppositeDirectionsAreNotTriedWhereOdometryIsSure) {
  EXPECT_TRUE(chooseKeyframePairs(row("a", 6, 6), row("b", 6, 6), odometry(0.0, 3.1, 0.1, 0.01), 6.0, 5).empty());
  EXPECT_FALSE(chooseKeyframePairs(row("a", 6, 6), row("b", 6, 6), odometry(0.0, 3.1, 0.1, 1.0), 6.0, 5).empty());
}

TEST(ViewPairs, NoViewsNoPairsAndNeverMoreThanAsked) {
  EXPECT_TRUE(chooseKeyframePairs({}, row("b", 6, 6), std::nullopt, 6.0, 5).empty());
  EXPECT_TRUE(chooseKeyframePairs(row("a", 6, 6), {}, std::nullopt, 6.0, 5).empty());
  EXPECT_EQ(chooseKeyframePairs(row("a", 6, 6), row("b", 6, 6), std::nullopt, 6.0, 2).size(), 2U);
  EXPECT_EQ(chooseKeyframePairs(row("a", 0, 0), row("b", 0, 0), std::nullopt, 6.0, 5).size(), 1U);  // none twice
}

}  // namespace
}  // namespace loop_metric
