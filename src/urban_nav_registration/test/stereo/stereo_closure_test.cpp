// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/stereo/stereo_closure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "urban_nav_core/parallel/for_each.hpp"
#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/numeric_jacobian.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_core/testing/textured_street.hpp"
#include "urban_nav_registration/testing/photographer.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;
using urban_nav_core::testing::Dice;
using urban_nav_core::testing::lookingAlong;
using urban_nav_core::testing::texturedRoom;
using urban_nav_core::testing::texturedStreet;
using urban_nav_registration::testing::Photographer;

void expectRight(const StereoClosure& closure, const Pose& truth, double metres, double rad) {
  EXPECT_EQ(closure.verdict, ClosureVerdict::Accepted) << closure.sentence;
  EXPECT_LT(urban_nav_core::distanceBetween(closure.lefts.T_a_b, truth), metres) << closure.sentence;
  EXPECT_LT(urban_nav_core::angleBetween(closure.lefts.T_a_b, truth), rad) << closure.sentence;
}

TEST(StereoMatcher, FindsMotionsOfMetresAndInformationThatHolds) {
  Photographer photographer(texturedStreet());
  StereoMatcher matcher(photographer.camera(), {});
  Dice dice(1);
  double nees = 0.0;
  const int pairs = 12;
  for (int i = 0; i < pairs; ++i) {
    const double x = dice.uniform(2.0, 60.0);
    const Pose a = lookingAlong({x, 0.0, 1.2}, 0.0),
               b = lookingAlong({x + dice.uniform(-2.5, 2.5), dice.uniform(-1.2, 1.2), 1.2 + dice.uniform(-0.1, 0.1)},
                                dice.uniform(-0.25, 0.25), dice.uniform(-0.03, 0.03), dice.uniform(-0.03, 0.03));
    const StereoClosure closure =
        matcher.match(photographer.keyframe(a), photographer.keyframe(b, dice.uniform(0.7, 1.2)));
    const Pose truth = a.inverse() * b;
    expectRight(closure, truth, 0.03, 0.0035);
    const Vector6d d = urban_nav_core::boxMinus(truth, closure.lefts.T_a_b);
    nees += d.dot(closure.lefts.information * d) / pairs;
    EXPECT_LE(closure.reprojection_px, 0.2);
    EXPECT_GE(closure.matches, 50);
  }
  EXPECT_LT(nees, 12.0);
  EXPECT_GT(nees, 0.5);
}

TEST(StereoMatcher, OtherPlacesAreRefused) {
  Photographer room(texturedRoom()), street(texturedStreet());
  StereoMatcher matcher(room.camera(), {});
  const Keyframe inside = room.keyframe(lookingAlong({0.0, 0.0, 1.0}, 0.2));
  Keyframe outside = street.keyframe(lookingAlong({20.0, 0.0, 1.2}, 0.0));
  outside.at.stamp = 1000;
  const StereoClosure closure = matcher.match(inside, outside);
  EXPECT_EQ(closure.verdict, ClosureVerdict::Rejected);
  EXPECT_NE(closure.reason, StereoReason::None);
  EXPECT_FALSE(closure.sentence.empty());
  EXPECT_TRUE(closure.lefts.information.isZero());
  Keyframe back = street.keyframe(lookingAlong({90.0, 0.0, 1.2}, 3.0));
  back.at.stamp = 1001;
  EXPECT_EQ(matcher.match(outside, back).verdict, ClosureVerdict::Rejected);
}

TEST(StereoMatcher, TheSameBitsWhateverTheThreadsAndWhatCameBefore) {
  Photographer photographer(texturedRoom());
  const Keyframe a = photographer.keyframe(lookingAlong({-1.0, 0.0, 1.0}, 0.2)),
                 b = photographer.keyframe(lookingAlong({0.0, 0.4, 1.0}, 0.1)),
                 c = photographer.keyframe(lookingAlong({0.5, 0.4, 1.0}, 0.4));
  StereoMatcher first(photographer.camera(), {}), second(photographer.camera(), {});
  StereoClosure x, y;
  {
    const urban_nav_core::ThreadLimit one(1);
    x = first.match(a, b);
  }
  {
    const urban_nav_core::ThreadLimit two(2);
    second.match(c, a);
    second.match(b, c);
    y = second.match(a, b);
  }
  EXPECT_EQ(x.lefts.T_a_b.t(), y.lefts.T_a_b.t());
  EXPECT_EQ(x.lefts.T_a_b.q().coeffs(), y.lefts.T_a_b.q().coeffs());
  EXPECT_EQ(x.lefts.information, y.lefts.information);
  EXPECT_EQ(x.sentence, y.sentence);
  EXPECT_EQ(x.pixels.size(), y.pixels.size());
}

TEST(StereoMatcher, BadViewsAreNamedAndNothingIsNaN) {
  Photographer photographer(texturedRoom());
  StereoMatcher matcher(photographer.camera(), {});
  const Keyframe good = photographer.keyframe(lookingAlong({0.0, 0.0, 1.0}, 0.2));
  const auto reasonWith = [&](Keyframe bad) {
    static urban_nav_core::StampNs stamp = 10'000;
    bad.at.stamp = ++stamp;
    const StereoClosure closure = matcher.match(good, bad);
    EXPECT_EQ(closure.verdict, ClosureVerdict::Rejected);
    EXPECT_TRUE(closure.lefts.T_a_b.isFinite());
    EXPECT_TRUE(closure.lefts.information.allFinite());
    EXPECT_FALSE(closure.sentence.empty());
    return closure.reason;
  };
  Keyframe bad = good;
  bad.image.clear();
  EXPECT_EQ(reasonWith(bad), StereoReason::NoImage);
  bad = good;
  bad.image.resize(20);
  EXPECT_EQ(reasonWith(bad), StereoReason::NoImage);
  bad = good;
  bad.points.clear();
  EXPECT_EQ(reasonWith(bad), StereoReason::TooFewPoints);
  bad = good;
  for (KeyframePoint& point : bad.points) point.disparity = 0.0F;
  EXPECT_EQ(reasonWith(bad), StereoReason::NoConsensus) << "everything at infinity";
}

TEST(StereoMatcher, DepthsOfChanceGiveNoWrongMotion) {
  Photographer photographer(texturedRoom());
  const Pose T_a = lookingAlong({0.0, 0.0, 1.0}, 0.2), T_b = lookingAlong({0.6, 0.3, 1.0}, 0.3);
  const Keyframe a = photographer.keyframe(T_a);
  Keyframe b = photographer.keyframe(T_b);
  Dice dice(3);
  for (KeyframePoint& point : b.points) point.disparity = static_cast<float>(dice.uniform(-1.0, 80.0));
  StereoMatcher matcher(photographer.camera(), {});
  const StereoClosure closure = matcher.match(a, b);
  EXPECT_TRUE(closure.lefts.T_a_b.isFinite());
  if (closure.verdict == ClosureVerdict::Accepted) expectRight(closure, T_a.inverse() * T_b, 0.05, 0.005);
}

TEST(StereoMatcher, AFrozenViewIsNoMotion) {
  Photographer photographer(texturedRoom());
  const Keyframe a = photographer.keyframe(lookingAlong({0.0, 0.0, 1.0}, 0.2));
  Keyframe b = a;
  b.at.stamp = 7777;
  StereoMatcher matcher(photographer.camera(), {});
  expectRight(matcher.match(a, b), Pose(), 1e-4, 1e-4);
}

TEST(BetweenBases, CarriesInformationAsItCarriesPoses) {
  const Pose T_base_left(urban_nav_core::expSo3({-1.2, 1.1, -1.3}), {0.3, 0.06, 1.1});
  urban_nav_core::Constraint lefts;
  lefts.T_a_b = Pose(urban_nav_core::expSo3({0.1, -0.3, 0.2}), {0.5, 0.2, -1.0});
  const auto toBase = [&](const Pose& T) { return T_base_left * T * T_base_left.inverse(); };
  const urban_nav_core::Matrix6d J = urban_nav_core::testing::numericJacobian<6, 6>(toBase, lefts.T_a_b);
  Vector6d weights;
  weights << 10.0, 20.0, 30.0, 400.0, 500.0, 0.0;
  lefts.information = weights.asDiagonal();
  const urban_nav_core::Constraint bases = betweenBases(lefts, T_base_left);
  EXPECT_TRUE(urban_nav_core::isApprox(bases.T_a_b, toBase(lefts.T_a_b), 1e-12));
  EXPECT_LT((J.transpose() * bases.information * J - lefts.information).cwiseAbs().maxCoeff(), 1e-4);
}

}  // namespace
}  // namespace urban_nav_registration
