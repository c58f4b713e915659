// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/assessment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_trust/closure_comparison.hpp"
#include "urban_nav_trust/depth_comparison.hpp"
#include "urban_nav_trust/motion_monitor.hpp"
#include "urban_nav_trust/position_probability.hpp"
#include "urban_nav_trust/session_comparisons.hpp"

namespace urban_nav_trust {
namespace {

/// 100 frames of 1 s and 1 m, each with a standard deviation of 0.05 m per axis.
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

/// Tests of turns and of lengths that pass.
std::vector<ConsistencyTest> bothPass() { return {makeTest(kTurnTest, 0.3, 0, 99), makeTest(kSpeedTest, 0.3, 0, 99)}; }

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

TEST(Assessment, IsKnownOnlyWhereBothTurnsAndLengthsWereCompared) {
  const auto assess = [](const std::vector<const char*>& names) {
    TestResults results;
    for (const char* name : names) results.tests.push_back(makeTest(name, 0.3, 0, 99));
    results.absent = {{kTurnTest, "no gyroscope"}, {kSpeedTest, "no wheels"}};
    return assessMap(assessFrames(drive(), results, true, {}), results, {});
  };
  EXPECT_EQ(assess({kTurnTest, kSpeedTest}).state, TrustState::Known);
  EXPECT_EQ(assess({kStereoClosureTest, kDepthScaleTest}).state, TrustState::Known);
  EXPECT_EQ(assess({kLaserClosureTest}).state, TrustState::Known);
  EXPECT_EQ(assess({kLidarTest}).state, TrustState::Known);
  const MapTrust without_wheels = assess({kTurnTest, kExchangeTest}), without_gyroscope = assess({kSpeedTest}),
                 without_both = assess({kClockTest});
  for (const MapTrust& map : {without_wheels, without_gyroscope, without_both}) {
    EXPECT_EQ(map.state, TrustState::Unsure);
    EXPECT_NE(map.reason.find("measured"), std::string::npos) << map.reason;
  }
  EXPECT_NE(without_wheels.reason.find("no wheels"), std::string::npos) << without_wheels.reason;
  EXPECT_NE(without_gyroscope.reason.find("no gyroscope"), std::string::npos) << without_gyroscope.reason;
}

// With a consistent covariance, 5 cm per axis would be within 10 cm with probability 0.739.
TEST(Assessment, ACovarianceThatNothingConfirmsGivesWideProbabilities) {
  TestResults nothing, confirmed;
  confirmed.tests = bothPass();
  ScaleWeights narrow;
  for (std::size_t i = 0; i < kScaleCount; ++i) narrow[i] = -30.0 * static_cast<double>(i);
  confirmed.turns.add(narrow);
  TestResults turns_alone = confirmed;
  confirmed.lengths.add(narrow);
  const double of_nothing = assessFrames(drive(), nothing, true, {})[5].probabilities[0],
               of_turns = assessFrames(drive(), turns_alone, true, {})[5].probabilities[0],
               of_both = assessFrames(drive(), confirmed, true, {})[5].probabilities[0];
  EXPECT_NEAR(of_both, probabilityWithin(0.1, std::pow(covarianceScales()[0] * 0.05, 2) * Eigen::Matrix3d::Identity()),
              1e-6);
  EXPECT_LT(of_nothing, 0.25);
  EXPECT_NEAR(of_turns, of_nothing, 1e-6) << "lengths are no more accurate";
  EXPECT_GT(of_both, of_nothing + 0.3);
}

TEST(Assessment, IsKnownWhereTestsPassAndOdometryIsNotLost) {
  auto evidence = drive();
  evidence[40].is_lost = true;
  TestResults results;
  results.tests = bothPass();
  const auto frames = assessFrames(evidence, results, true, {});
  for (std::size_t i = 0; i < frames.size(); ++i)
    EXPECT_EQ(frames[i].state, i == 40 ? TrustState::Lost : TrustState::Known) << i;
  const MapTrust map = assessMap(frames, results, {});
  EXPECT_EQ(map.state, TrustState::Known);
  EXPECT_TRUE(map.reason.empty());
}

TEST(Assessment, AMapOfWhichMoreThanATenthIsPredictedIsUnsure) {
  TestResults results;
  results.tests = bothPass();
  for (const std::size_t lost : {10U, 11U}) {
    auto evidence = drive();
    for (std::size_t i = 0; i < lost; ++i) evidence[30 + i].is_lost = true;
    const MapTrust map = assessMap(assessFrames(evidence, results, true, {}), results, {});
    EXPECT_EQ(map.state, lost > 10 ? TrustState::Unsure : TrustState::Known) << lost;
    EXPECT_EQ(map.reason.find("11 %") != std::string::npos, lost > 10) << map.reason;
  }
}

TEST(Assessment, AFailureWhoseCauseWasCorrectedAffectsItsIntervalOnly) {
  TestResults results;
  results.tests = bothPass();
  results.tests.push_back(makeTest("a", 1e-9, 50, 52));
  results.tests.back().is_corrected = true;
  for (const bool spreads : {false, true}) {
    const auto frames = assessFrames(drive(), results, spreads, {});
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const bool is_inside = i >= 50 && i <= 52;
      EXPECT_EQ(frames[i].state, is_inside ? TrustState::Unsure : TrustState::Known) << i;
      EXPECT_EQ(frames[i].tests, is_inside ? "a" : "") << i;
    }
    EXPECT_LT(frames[99].probabilities[0], frames[49].probabilities[0] + (spreads ? 1e-9 : 0.0))
        << "positions are off by the drift of the interval";
    EXPECT_NEAR(frames[99].probabilities[0], frames[60].probabilities[0], 1e-9);
    const MapTrust map = assessMap(frames, results, {});
    EXPECT_EQ(map.state, TrustState::Known);
    EXPECT_TRUE(map.reason.empty()) << map.reason;
  }
}

TEST(Assessment, AFailureOfTheMapAloneLeavesPositionsKnown) {
  TestResults results;
  results.tests = bothPass();
  const auto sound = assessFrames(drive(), results, true, {});
  results.tests.push_back(makeTest("a", 1e-9, 50, 52));
  results.tests.back().affects_position = false;
  const auto frames = assessFrames(drive(), results, true, {});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].state, TrustState::Known) << i;
    EXPECT_EQ(frames[i].probabilities, sound[i].probabilities) << i;
    EXPECT_EQ(frames[i].tests, "a") << i;
  }
  EXPECT_EQ(assessMap(frames, results, {}).state, TrustState::Unsure);
}

TEST(Assessment, AFailureWidensAndNamesItselfFromItsBeginOn) {
  TestResults results;
  results.tests = bothPass();
  results.tests.push_back(makeTest("a", 1e-9, 50, 99));
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
  // Closures propagate the error to the path before.
  const auto spread = assessFrames(drive(), results, true, parameters);
  EXPECT_EQ(spread[10].state, TrustState::Unsure);
  EXPECT_EQ(spread[10].probabilities, spread[99].probabilities);
}

TEST(Assessment, SessionsThatJoinNothingAreNew) {
  auto evidence = drive();
  for (FrameEvidence& frame : evidence) frame.is_joined = false;
  TestResults results;
  results.tests = bothPass();
  const auto frames = assessFrames(evidence, results, true, {});
  EXPECT_EQ(frames[5].state, TrustState::New);
  EXPECT_EQ(assessMap(frames, results, {}).state, TrustState::New);
}

TEST(Assessment, MostlyLostIsLostAndNoPoseIsUnsure) {
  auto evidence = drive();
  for (std::size_t i = 0; i < 60; ++i) evidence[i].is_lost = true;
  TestResults results;
  results.tests = bothPass();
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
