// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/evidence_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace loop_metric {
namespace {

using urban_nav_core::ClosureVerdict;

Evidence::Try madeBy(urban_nav_core::ClosureMethod method, ClosureVerdict verdict,
                     std::vector<urban_nav_registration::ClosureTest> tests) {
  Evidence::Try attempt;
  attempt.method = method;
  attempt.verdict = verdict;
  attempt.tests = std::move(tests);
  return attempt;
}

Evidence rejectedThenAccepted() {
  Evidence evidence;
  evidence.tries.push_back(madeBy(urban_nav_core::ClosureMethod::Stereo, ClosureVerdict::Rejected,
                                  {{"matches", 51.0, 50.0, true, true}, {"share", 0.29, 0.3, true, false}}));
  evidence.tries.push_back(madeBy(urban_nav_core::ClosureMethod::Icp, ClosureVerdict::Accepted,
                                  {{"overlap", 0.9, 0.5, true, true}, {"residual_m", 0.04, 0.05, false, true}}));
  evidence.gate.push_back({"distance_m", 3.0, 9.0, false, true});
  return evidence;
}

TEST(EvidenceText, NamesTheNearestTestOfTheTryThatWasAccepted) {
  EXPECT_EQ(nearestTest(rejectedThenAccepted()).value().name, "residual_m");
  Evidence close_gate = rejectedThenAccepted();
  close_gate.gate[0].value = 8.9;
  EXPECT_EQ(nearestTest(close_gate).value().name, "distance_m");
}

TEST(EvidenceText, NamesTheFailedTestOfARejectedClosure) {
  Evidence evidence = rejectedThenAccepted();
  evidence.tries.pop_back();
  evidence.gate.clear();
  EXPECT_EQ(nearestTest(evidence).value().name, "share");
  Evidence by_gate = rejectedThenAccepted();
  by_gate.tries.erase(by_gate.tries.begin());
  by_gate.gate[0] = {"distance_m", 900.0, 9.0, false, false};
  EXPECT_EQ(nearestTest(by_gate).value().name, "distance_m") << "the gate rejected it, however far it failed";
}

TEST(EvidenceText, ComparesTestsWithoutFiniteRatios) {
  Evidence evidence;
  evidence.tries.push_back(madeBy(urban_nav_core::ClosureMethod::Icp, ClosureVerdict::Rejected,
                                  {{"ratio", std::numeric_limits<double>::quiet_NaN(), 1.0, false, false},
                                   {"second_pose", 0.2, 0.0, false, false}}));
  EXPECT_EQ(nearestTest(evidence).value().name, "second_pose");
  EXPECT_FALSE(nearestTest(Evidence()).has_value());
}

TEST(EvidenceText, ListsEveryTestWithItsLimit) {
  const std::string text = describe(rejectedThenAccepted());
  EXPECT_NE(text.find("  Two views (1 of 2 tries): rejected\n"), std::string::npos) << text;
  EXPECT_NE(text.find("    failed  share = 0.29 (>= 0.3)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("    passed  residual_m = 0.04 (<= 0.05)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("    passed  distance_m = 3 (<= 9)\n"), std::string::npos) << text;
  EXPECT_EQ(describe(Evidence()), "");
}

}  // namespace
}  // namespace loop_metric
