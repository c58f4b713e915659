// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rendered.hpp"
#include "urban_nav_core/image/pyramid.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::expSo3;
using urban_nav_core::Pose;
using urban_nav_core::Pyramid;
using urban_nav_core::Quaterniond;
using urban_nav_core::Vector3d;
using namespace urban_nav_core::testing;

constexpr double kDegree = M_PI / 180.0;

/// Returns the error of the rotation between two views from one position, deg.
double computeError(const Vector3d& turn, double gain, const std::vector<Parallax>& known = {},
                    const Quaterniond& start_of_search = Quaterniond::Identity()) {
  SequenceOptions options = smallCamera(2.0);
  options.gain = [gain](double t) { return t > 0.0 ? gain : 1.0; };
  const Pose start = lookingAlong({0.3, 0.2, 1.2}, 0.4);
  const Pose turned = start * Pose(expSo3(turn), Vector3d::Zero());
  RenderedSequence sequence(
      texturedRoom(), [&](double t) { return t > 0.0 ? turned : start; }, options);
  RotationTracker tracker(makeCamera(options.camera).left);
  Pyramid pyramid(3);
  for (int i = 0; i < 2; ++i) {
    pyramid.build(sequence.frame(i).left.view());
    const RotationEstimate found = tracker.track(pyramid.level(2), 2, start_of_search, known);
    EXPECT_EQ(found.found, i == 1);
    if (i == 1) return found.q_now_last.angularDistance(expSo3(-turn)) / kDegree;
  }
  return 180.0;
}

TEST(Rotation, ThreeDegreesAFrameAreFound) {
  EXPECT_LT(computeError({0.0, 3.0 * kDegree, 0.0}, 1.0), 0.1);
  EXPECT_LT(computeError({0.0, -3.0 * kDegree, 0.0}, 1.0), 0.1);
  EXPECT_LT(computeError({3.0 * kDegree, 0.0, 0.0}, 1.0), 0.1);
  EXPECT_LT(computeError({0.0, 0.0, 3.0 * kDegree}, 1.0), 0.1);
  EXPECT_LT(computeError({1.0 * kDegree, 2.0 * kDegree, -2.0 * kDegree}, 1.0), 0.1);
}

TEST(Rotation, SixtyDegreesASecondAtTenHertzAreFound) { EXPECT_LT(computeError({0.0, 6.0 * kDegree, 0.0}, 1.0), 0.2); }

TEST(Rotation, ACameraThatTurnsBackIsFoundWhereALargeTurnWasPredicted) {
  for (const double predicted : {-12.0, 12.0})
    EXPECT_LT(computeError({0.0, 1.0 * kDegree, 0.0}, 1.0, {}, expSo3({0.0, predicted * kDegree, 0.0})), 0.1);
}

TEST(Rotation, BrightnessDoesNotMatter) {
  EXPECT_LT(computeError({0.0, 3.0 * kDegree, 0.0}, 0.5), 0.15);
  EXPECT_LT(computeError({0.0, 3.0 * kDegree, 0.0}, 1.4), 0.3);  // bright parts are saturated
}

TEST(Rotation, KnownPlacesSuffice) {
  std::vector<Parallax> known;
  for (int i = 0; i < 60; ++i)
    known.push_back({Eigen::Vector2d(40.0 + 4.0 * i, 40.0 + (i * 37) % 160), Vector3d::Zero()});
  EXPECT_LT(computeError({0.0, 3.0 * kDegree, 0.0}, 1.0, known), 0.15);
}

TEST(Rotation, WhatDoesNotTurnKeepsTheStart) {
  SequenceOptions options = smallCamera(1.0);
  RenderedSequence sequence(texturedRoom(), standing(lookingAlong({0.0, 0.0, 1.2}, 0.4)), options);
  RotationTracker tracker(makeCamera(options.camera).left);
  Pyramid pyramid(3);
  RotationEstimate found;
  for (int i = 0; i < 3; ++i) {
    pyramid.build(sequence.frame(i).left.view());
    found = tracker.track(pyramid.level(2), 2, Quaterniond::Identity(), {});
  }
  EXPECT_LT(found.q_now_last.angularDistance(Quaterniond::Identity()) / kDegree, 0.02);
  const std::vector<std::uint8_t> black(80 * 60, 0);
  EXPECT_FALSE(tracker.track({black.data(), 80, 60, 80}, 2, Quaterniond::Identity(), {}).found);
  EXPECT_FALSE(tracker.track({black.data(), 80, 60, 80}, 2, Quaterniond::Identity(), {}).found);
  EXPECT_FALSE(tracker.track({black.data(), 40, 60, 80}, 2, Quaterniond::Identity(), {}).found);
}

}  // namespace
}  // namespace swf_vo
