// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/test_results.hpp"

#include <algorithm>
#include <array>

#include "urban_nav_trust/closure_comparison.hpp"
#include "urban_nav_trust/depth_comparison.hpp"
#include "urban_nav_trust/motion_monitor.hpp"
#include "urban_nav_trust/offset_monitor.hpp"
#include "urban_nav_trust/reprojection_monitor.hpp"
#include "urban_nav_trust/session_comparisons.hpp"

namespace urban_nav_trust {

namespace {

/// Component of the motion compared by a test; other tests compare something else.
struct Subject {
  const char* test;
  bool turns, lengths;
};
constexpr std::array<Subject, 6> kSubjects = {{{kTurnTest, true, false},
                                               {kSpeedTest, false, true},
                                               {kDepthScaleTest, false, true},
                                               {kStereoClosureTest, true, false},
                                               {kLaserClosureTest, true, true},
                                               {kLidarTest, true, true}}};

/// Returns the tests of turns or of lengths that were absent, each with its reason.
std::string absentSentence(bool Subject::*what, const TestResults& results) {
  std::string text;
  for (const Subject& subject : kSubjects)
    for (const AbsentMeasurement& absent : results.absent)
      if (subject.*what && absent.name == subject.test)
        text += (text.empty() ? "" : "; ") + absent.name + ": " + absent.reason;
  return text.empty() ? "" : " (" + text + ")";
}

}  // namespace

Confirmation confirm(const TestResults& results) {
  Confirmation confirmation;
  for (const ConsistencyTest& test : results.tests) {
    confirmation.any |= test.name != kOffsetTest && test.name != kReprojectionTest;
    for (const Subject& subject : kSubjects) {
      if (test.name != subject.test) continue;
      confirmation.turns |= subject.turns;
      confirmation.lengths |= subject.lengths;
    }
  }
  // One estimator states both, so one factor is common unless a test separates turns from lengths.
  confirmation.scales = results.turns.isEmpty() && results.lengths.isEmpty()
                            ? ScaleEvidence().probabilities()
                            : largerScale(results.turns.probabilities(), results.lengths.probabilities());
  return confirmation;
}

std::string missingSentence(const Confirmation& confirmation, const TestResults& results) {
  if (confirmation.isComplete()) return "";
  if (!confirmation.any) return "nothing could be compared: each quantity was measured by one sensor only";
  if (!confirmation.turns && !confirmation.lengths)
    return "no other sensor measured turns or lengths" + absentSentence(&Subject::turns, results);
  return confirmation.turns ? "no other sensor measured lengths" + absentSentence(&Subject::lengths, results)
                            : "no other sensor measured turns" + absentSentence(&Subject::turns, results);
}

}  // namespace urban_nav_trust
