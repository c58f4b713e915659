// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/evidence.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace loop_metric {
namespace {

using urban_nav_registration::MatchedPixels;

Evidence someEvidence() {
  Evidence evidence;
  Evidence::Try views;
  views.method = urban_nav_core::ClosureMethod::Stereo;
  views.keyframe_a = {"monday", 12};
  views.keyframe_b = {"tuesday, the \"second\"", 34};
  views.verdict = urban_nav_core::ClosureVerdict::Rejected;
  views.reason = "small_share";
  views.sentence = "alike, in parts";
  views.tests.push_back({"matches", 51.0, 50.0, true, true});
  views.tests.push_back({"share", 0.1, 0.3, true, false});
  MatchedPixels pixels;
  pixels.in_a = {1.5, 2.25};
  pixels.in_b = {300.125, 17.0};
  pixels.residual_px = 0.07;
  pixels.inlier = true;
  views.pixels.push_back(pixels);
  evidence.tries.push_back(views);
  Evidence::Try clouds;
  clouds.method = urban_nav_core::ClosureMethod::Icp;
  clouds.keyframe_a = {"monday", 12};
  clouds.keyframe_b = {"tuesday", 34};
  clouds.verdict = urban_nav_core::ClosureVerdict::Degenerate;
  clouds.guess = urban_nav_core::Pose();
  clouds.T_a_b = urban_nav_core::expSe3((urban_nav_core::Vector6d() << 1.0, -2.5, 0.1, 0.02, -0.3, 3.0).finished());
  evidence.tries.push_back(clouds);
  evidence.gate.push_back({"distance_m", 3.0, 9.0, false, true});
  return evidence;
}

TEST(Evidence, ReadsBackAsItWasWritten) {
  const Evidence evidence = someEvidence();
  const std::string text = printEvidence(evidence);
  const Evidence again = parseEvidence(text);
  ASSERT_EQ(again.tries.size(), 2U);
  EXPECT_EQ(again.tries[0].keyframe_b, evidence.tries[0].keyframe_b);
  EXPECT_EQ(again.tries[0].method, urban_nav_core::ClosureMethod::Stereo);
  EXPECT_EQ(again.tries[0].verdict, urban_nav_core::ClosureVerdict::Rejected);
  EXPECT_EQ(again.tries[0].sentence, evidence.tries[0].sentence);
  EXPECT_EQ(again.tries[0].pixels.at(0).in_b, evidence.tries[0].pixels[0].in_b);
  EXPECT_FALSE(again.tries[0].T_a_b.has_value());
  EXPECT_EQ(again.tries[1].guess.value().matrix(), evidence.tries[1].guess->matrix());
  EXPECT_LT(distanceBetween(again.tries[1].T_a_b.value(), *evidence.tries[1].T_a_b), 1e-12);
  EXPECT_LT(angleBetween(again.tries[1].T_a_b.value(), *evidence.tries[1].T_a_b), 1e-12);
  EXPECT_EQ(again.tries[1].method, urban_nav_core::ClosureMethod::Icp);
  EXPECT_EQ(again.tries[1].verdict, urban_nav_core::ClosureVerdict::Degenerate);
  EXPECT_NE(text.find("\ntry,icp,"), std::string::npos) << "stores of earlier versions have these words";
  EXPECT_NE(text.find("\nverdict,degenerate,"), std::string::npos);
  EXPECT_EQ(printEvidence(again), text);
  EXPECT_EQ(parseEvidence(printEvidence({})).tries.size(), 0U);
}

TEST(Evidence, NothingThatIsNoNumberIsWritten) {
  Evidence evidence = someEvidence();
  evidence.gate[0].value = std::numeric_limits<double>::quiet_NaN();
  evidence.tries[0].tests[0].value = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(parseEvidence(printEvidence(evidence)));
}

TEST(Evidence, IsFoundAfterOtherText) {
  const std::string text = printEvidence(someEvidence());
  EXPECT_EQ(evidenceIn("session_a,stamp\n0,1\n" + text), text);
  EXPECT_EQ(evidenceIn(text), text);
  EXPECT_EQ(evidenceIn("something else\n"), "");
  EXPECT_EQ(evidenceIn(""), "");
}

TEST(Evidence, DamageIsDataAndNamesItsLine) {
  for (const char* line :
       {"pixels,,1,2,,1,3,,4,,5\n", "judge,,,,,,,,,,\n", "gate,x,1,2,7,1,,,,,\n", "gate,x,one,2,1,1,,,,,\n",
        "try,lidar,,,,,monday,1,tuesday,2,\n", "try,none,,,,,monday,1,tuesday,2,\n"}) {
    std::string text = printEvidence({});
    text += line;
    try {
      parseEvidence(text);
      ADD_FAILURE() << line;
    } catch (const urban_nav_core::DataError& error) {
      EXPECT_NE(std::string(error.what()).find("evidence:2"), std::string::npos) << error.what();
    }
  }
  const std::string begun = printEvidence({}) + "try,icp,,,,,monday,1,tuesday,2,\n";
  for (const char* numbers : {"", "1 2 3", "1 2 3 0 0 0 2", "1 2 3 0 0 0 1 0", "1 2 3 0 0 0 nan", "1 2 x 0 0 0 1"})
    EXPECT_THROW(parseEvidence(begun + "transform,T_a_b,,,,,,,,," + numbers + "\n"), urban_nav_core::DataError)
        << numbers;
  EXPECT_NO_THROW(parseEvidence(begun + "verdict,rejected,,,,,,,,,\n"));
  EXPECT_THROW(parseEvidence(begun + "verdict,good,,,,,,,,,\n"), urban_nav_core::DataError);
  EXPECT_THROW(parseEvidence(""), urban_nav_core::DataError);
}

TEST(Evidence, FuzzedTextIsReadOrRefused) {
  const urban_nav_core::testing::FuzzResult result = urban_nav_core::testing::fuzzText(
      {printEvidence(someEvidence()), printEvidence({})}, [](const std::string& text) { parseEvidence(text); });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.refused, 0);
}

}  // namespace
}  // namespace loop_metric
