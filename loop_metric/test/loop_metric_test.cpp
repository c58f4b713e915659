// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/loop_metric.hpp"

#include <gtest/gtest.h>

#include "loop_metric/evidence.hpp"
#include "support/line_place_data.hpp"
#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/scanner.hpp"
#include "urban_nav_core/testing/textured_street.hpp"
#include "urban_nav_registration/testing/photographer.hpp"

namespace loop_metric {
namespace {

using testing::LinePlaceData;
using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::Pose;
using urban_nav_core::PoseRef;
using urban_nav_core::StampNs;
using urban_nav_core::TopologicalClosure;
using urban_nav_core::testing::lookingAlong;
using urban_nav_registration::Keyframe;
using urban_nav_registration::testing::Photographer;

constexpr StampNs kSecond = 1'000'000'000;

/// A drive along a street, a metre per second, a keyframe each metre. base_link is the left camera here.
struct Drive {
  std::vector<Pose> poses;
};
Drive drive(LinePlaceData& around, Photographer& photographer, const std::string& session, double from, double to,
            double y) {
  Drive made;
  for (double x = from; x <= to; x += 1.0) made.poses.push_back(lookingAlong({x, y, 1.2}, 0.02 * y));
  around.drive(session, made.poses, 0.002, 0.0002);
  for (std::size_t i = 0; i < made.poses.size(); ++i) {
    const PoseRef at{session, static_cast<StampNs>(i) * kSecond};
    Keyframe keyframe = photographer.keyframe(made.poses[i]);
    keyframe.at = at;
    around.keyframes[at] = keyframe;
  }
  return made;
}

/// Two drives along one street. Rendered once: each test modifies a copy.
struct Rendered {
  Photographer photographer{urban_nav_core::testing::texturedStreet()};
  LinePlaceData around;
  Drive a = drive(around, photographer, "monday", 4.0, 16.0, 0.0),
        b = drive(around, photographer, "tuesday", 4.0, 16.0, 0.7);
};
const Rendered& rendered() {
  static const Rendered made;
  return made;
}

struct Street {
  LinePlaceData around = rendered().around;
  LoopMetric stage{Parameters(), rendered().photographer.camera(), Pose()};

  TopologicalClosure candidate(double at_a, double at_b) const {
    const auto stamp = [](double s) { return static_cast<StampNs>(s * 1e9); };
    return {{"monday", stamp(at_a)}, {"tuesday", stamp(at_b)}, 0.9};
  }
};

std::string toReason(const CandidateMeasurement& closure) {
  EXPECT_EQ(closure.metric.verdict, ClosureVerdict::Rejected);
  EXPECT_TRUE(closure.metric.measured.information.isZero(0.0));
  EXPECT_FALSE(closure.metric.sentence.empty());
  EXPECT_TRUE(closure.metric.measured.T_a_b.isFinite());
  return closure.metric.reason_name;
}

TEST(LoopMetric, TwoViewsOfAPlaceAreATransformBetweenTheMomentsThemselves) {
  Street street;
  const CandidateMeasurement closure = street.stage.measure(street.candidate(3.4, 4.3), street.around);
  ASSERT_EQ(closure.metric.verdict, ClosureVerdict::Accepted) << closure.metric.sentence;
  EXPECT_EQ(closure.metric.method, ClosureMethod::Stereo);
  const Pose truth = lookingAlong({7.4, 0.0, 1.2}, 0.0).inverse() * lookingAlong({8.3, 0.7, 1.2}, 0.014);
  EXPECT_LT(urban_nav_core::distanceBetween(closure.metric.measured.T_a_b, truth), 0.03);
  EXPECT_LT(urban_nav_core::angleBetween(closure.metric.measured.T_a_b, truth), 0.0035);
  EXPECT_FALSE(closure.metric.odometry_gate);  // the relative pose of the two days is unknown
}

TEST(LoopMetric, MomentsThatAreTooFarApartAreNotOnePlaceHoweverRightTheTransform) {
  Street street;
  EXPECT_EQ(toReason(street.stage.measure(street.candidate(1.0, 11.0), street.around)), "other_place");
}

TEST(LoopMetric, OdometryOfOneSessionRulesOutWhatItDoesNotAllow) {
  Street street;
  LinePlaceData& around = street.around;
  // A single session whose odometry places the second pass four metres further on.
  std::vector<Pose> poses = rendered().a.poses;
  for (const Pose& pose : rendered().b.poses)
    poses.push_back(Pose(pose.q(), pose.t() + Eigen::Vector3d(4.0, 0.0, 0.0)));
  around.drive("both", poses, 0.002, 0.0002);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const PoseRef at{"both", static_cast<StampNs>(i) * kSecond};
    const std::size_t of_b = i - rendered().a.poses.size();
    around.keyframes[at] = i < rendered().a.poses.size()
                               ? around.keyframe({"monday", at.stamp})
                               : around.keyframe({"tuesday", static_cast<StampNs>(of_b) * kSecond});
    around.keyframes[at].at = at;
  }
  const auto second = static_cast<StampNs>(rendered().a.poses.size()) * kSecond;
  const TopologicalClosure candidate{{"both", 4 * kSecond}, {"both", second + 4 * kSecond}, 0.9};
  EXPECT_EQ(toReason(street.stage.measure(candidate, around)), "odometry");
  const TopologicalClosure far{{"both", 0}, {"both", second + 12 * kSecond}, 0.9};
  const CandidateMeasurement closure = street.stage.measure(far, around);
  EXPECT_EQ(toReason(closure), "odometry");
  EXPECT_TRUE(closure.attempts.stereo.empty());  // sixteen metres apart by odometry: no keyframes are matched
}

TEST(LoopMetric, CloudsServeWhereThereAreNoViews) {
  const urban_nav_core::testing::World world = urban_nav_core::testing::courtyard(5);
  const std::vector<Pose> poses = {urban_nav_core::testing::stand(0, 0, 0), urban_nav_core::testing::stand(1, 0, 0)},
                          others = {urban_nav_core::testing::stand(1.5, 1.0, 175.0),
                                    urban_nav_core::testing::stand(0.5, 1.0, 175.0)};
  LinePlaceData around;
  around.drive("there", poses, 0.01, 0.001);
  around.drive("back", others, 0.01, 0.001);
  around.clouds = [&](const PoseRef& at) {
    const auto& its = at.session == "there" ? poses : others;
    return urban_nav_core::testing::scan(world, its[static_cast<std::size_t>(at.stamp / kSecond)], {},
                                         at.session == "there" ? 1U : 2U);
  };
  LoopMetric stage(Parameters(), {}, Pose());
  const CandidateMeasurement closure = stage.measure({{"there", 0}, {"back", 0}, 0.9}, around);
  ASSERT_EQ(closure.metric.verdict, ClosureVerdict::Accepted) << closure.metric.sentence;
  EXPECT_EQ(closure.metric.method, ClosureMethod::Icp);
  EXPECT_LT(urban_nav_core::distanceBetween(closure.metric.measured.T_a_b, poses[0].inverse() * others[0]), 0.1);
  Parameters without;
  without.icp = false;
  EXPECT_EQ(toReason(LoopMetric(without, {}, Pose()).measure({{"there", 0}, {"back", 0}, 0.9}, around)),
            "nothing_kept");
}

TEST(LoopMetric, AFacadeIsNoProofOfAPlaceUnlessOdometryHasBroughtUsThere) {
  const urban_nav_core::testing::World world = urban_nav_core::testing::facade();
  const std::vector<Pose> poses = {urban_nav_core::testing::stand(0, 0, 0), urban_nav_core::testing::stand(1, 0, 0),
                                   urban_nav_core::testing::stand(1.5, 0.2, 3.0)};
  LinePlaceData around;
  around.drive("there", poses, 0.02, 0.001);
  around.drive("another day", {poses[2], poses[1]}, 0.02, 0.001);
  around.clouds = [&](const PoseRef& at) {
    const bool later = at.session == "another day";
    return urban_nav_core::testing::scan(world, later ? poses[2] : poses[static_cast<std::size_t>(at.stamp / kSecond)],
                                         {}, later ? 2U : 1U);
  };
  LoopMetric stage(Parameters(), {}, Pose());
  const CandidateMeasurement slid = stage.measure({{"there", 0}, {"another day", 0}, 0.9}, around);
  EXPECT_EQ(toReason(slid), "not_registered");
  const CandidateMeasurement held = stage.measure({{"there", 0}, {"there", 2 * kSecond}, 0.9}, around);
  ASSERT_EQ(held.metric.verdict, ClosureVerdict::Accepted) << held.metric.sentence;
  EXPECT_FALSE(held.metric.free_directions.empty());
  const auto d = urban_nav_core::boxMinus(poses[0].inverse() * poses[2], held.metric.measured.T_a_b);
  EXPECT_LT(d.dot(held.metric.measured.information * d), 22.5);  // chi-square of six at 0.999: consistent with its
                                                                 // information
}

TEST(LoopMetric, UnknownMomentsAndEmptyPlacesAreNamed) {
  Street street;
  EXPECT_EQ(toReason(street.stage.measure(street.candidate(3.0, 500.0), street.around)), "unknown_moment");
  EXPECT_EQ(toReason(street.stage.measure({{"monday", 0}, {"sunday", 0}, 0.5}, street.around)), "unknown_moment");
  street.around.keyframes.clear();
  EXPECT_EQ(toReason(street.stage.measure(street.candidate(3.0, 3.0), street.around)), "nothing_kept");
}

TEST(LoopMetric, TheSameBitsWhateverCameBefore) {
  Street street;
  const CandidateMeasurement first = street.stage.measure(street.candidate(3.4, 4.3), street.around);
  street.stage.measure(street.candidate(9.0, 10.0), street.around);
  const CandidateMeasurement again = street.stage.measure(street.candidate(3.4, 4.3), street.around);
  EXPECT_EQ(first.metric.measured.T_a_b.matrix(), again.metric.measured.T_a_b.matrix());
  EXPECT_EQ(first.metric.measured.information, again.metric.measured.information);
  EXPECT_EQ(first.metric.evidence, again.metric.evidence);
}

TEST(LoopMetric, EvidenceHoldsTheTestsTheViewsAndTheMatches) {
  Street street;
  const CandidateMeasurement closure = street.stage.measure(street.candidate(3.4, 4.3), street.around);
  const Evidence evidence = parseEvidence(closure.metric.evidence);
  ASSERT_FALSE(evidence.tries.empty());
  const Evidence::Try& last = evidence.tries.back();
  EXPECT_EQ(last.method, ClosureMethod::Stereo);
  EXPECT_EQ(last.verdict, ClosureVerdict::Accepted);
  EXPECT_EQ(last.keyframe_a, closure.attempts.stereo.back().keyframe_a.at);
  EXPECT_EQ(last.keyframe_b, closure.attempts.stereo.back().keyframe_b.at);
  ASSERT_EQ(last.tests.size(), closure.attempts.stereo.back().result.tests.size());
  for (std::size_t i = 0; i < last.tests.size(); ++i) {
    EXPECT_EQ(last.tests[i].name, closure.attempts.stereo.back().result.tests[i].name);
    EXPECT_EQ(last.tests[i].value, closure.attempts.stereo.back().result.tests[i].value);
  }
  EXPECT_GE(last.pixels.size(), 20U);
  EXPECT_EQ(evidence.gate.size(), closure.attempts.tests.size());
}

}  // namespace
}  // namespace loop_metric
