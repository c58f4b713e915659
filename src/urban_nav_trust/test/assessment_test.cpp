// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/assessment.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_trust {
namespace {

/// 100 frames of 1 s and 1 m, each known to 0.05 m per axis.
std::vector<FrameEvidence> drive() {
  std::vector<FrameEvidence> frames(100);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].stamp = static_cast<urban_nav_core::StampNs>(i) * 1'000'000'000;
    frames[i].travelled = static_cast<double>(i);
    frames[i].covariance = 0.0025 * Eigen::Matrix3d::Identity();
  }
  return frames;
}

ConsistencyTest makeTest(const std::string& name, double p, std::size_t from, std::size_t to) {
  const auto frames = drive();
  return {name, {frames[from].stamp, frames[to].stamp}, 1.0, 1.0, p, name + " differs.", "Repair it."};
}

TEST(Assessment, WithNothingToCompareItIsUnsureWithAReason) {
  const auto frames = assessFrames(drive(), {}, true, {});
  for (const FrameTrust& frame : frames) EXPECT_EQ(frame.state, TrustState::Unsure);
  const MapTrust map = assessMap(frames, {}, {});
  EXPECT_EQ(map.state, TrustState::Unsure);
  EXPECT_FALSE(map.reason.empty());
  EXPECT_NEAR(map.probabilities[0], frames[0].probabilities[0], 1e-12);
}

TEST(Assessment, ASensorThatAgreesWithItselfConfirmsNothing) {
  TestResults results;
  results.tests = {makeTest("disparity_offset", 0.9, 0, 99)};
  const auto frames = assessFrames(drive(), results, true, {});
  EXPECT_EQ(frames[5].state, TrustState::Unsure);
  EXPECT_EQ(assessMap(frames, results, {}).state, TrustState::Unsure);
}

TEST(Assessment, IsKnownWhereTestsPassAndOdometryIsNotLost) {
  auto evidence = drive();
  evidence[40].is_lost = true;
  TestResults results;
  results.tests = {makeTest("a", 0.3, 0, 99)};
  const auto frames = assessFrames(evidence, results, true, {});
  for (std::size_t i = 0; i < frames.size(); ++i)
    EXPECT_EQ(frames[i].state, i == 40 ? TrustState::Lost : TrustState::Known) << i;
  const MapTrust map = assessMap(frames, results, {});
  EXPECT_EQ(map.state, TrustState::Known);
  EXPECT_TRUE(map.reason.empty());
}

TEST(Assessment, AFailureWidensAndNamesItselfFromItsBeginOn) {
  TestResults results;
  results.tests = {makeTest("a", 1e-9, 50, 99), makeTest("b", 0.5, 0, 99)};
  Parameters parameters;
  parameters.unexplained_drift = 2.0;
  const auto frames = assessFrames(drive(), results, false, parameters);
  EXPECT_EQ(frames[49].state, TrustState::Known);
  EXPECT_TRUE(frames[49].tests.empty());
  EXPECT_EQ(frames[50].state, TrustState::Unsure);
  EXPECT_EQ(frames[50].tests, "a");
  EXPECT_NEAR(frames[50].probabilities[0], frames[49].probabilities[0], 1e-9);  // no distance yet
  EXPECT_LT(frames[90].probabilities[1], frames[60].probabilities[1]);
  const MapTrust map = assessMap(frames, results, parameters);
  EXPECT_EQ(map.state, TrustState::Unsure);
  EXPECT_EQ(map.reason, "a differs.");
  // Closures hand the error on to the path before.
  const auto spread = assessFrames(drive(), results, true, parameters);
  EXPECT_EQ(spread[10].state, TrustState::Unsure);
  EXPECT_EQ(spread[10].probabilities, spread[99].probabilities);
}

TEST(Assessment, SessionsThatJoinNothingAreNew) {
  auto evidence = drive();
  for (FrameEvidence& frame : evidence) frame.is_joined = false;
  TestResults results;
  results.tests = {makeTest("a", 0.3, 0, 99)};
  const auto frames = assessFrames(evidence, results, true, {});
  EXPECT_EQ(frames[5].state, TrustState::New);
  EXPECT_EQ(assessMap(frames, results, {}).state, TrustState::New);
}

TEST(Assessment, MostlyLostIsLostAndNoPoseIsUnsure) {
  auto evidence = drive();
  for (std::size_t i = 0; i < 60; ++i) evidence[i].is_lost = true;
  TestResults results;
  results.tests = {makeTest("a", 0.3, 0, 99)};
  EXPECT_EQ(assessMap(assessFrames(evidence, results, true, {}), results, {}).state, TrustState::Lost);
  EXPECT_EQ(assessMap({}, results, {}).state, TrustState::Unsure);
  EXPECT_FALSE(assessMap({}, results, {}).reason.empty());
}

TEST(Assessment, APValueThatIsNoNumberFails) {
  ConsistencyTest test;
  test.p_value = std::nan("");
  EXPECT_TRUE(hasFailed(test, {}));
}

}  // namespace
}  // namespace urban_nav_trust
