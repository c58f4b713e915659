// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <sstream>

#include "urban_nav_trust/assessment.hpp"

namespace urban_nav_trust {
namespace {

/// Ten metres after a failure with a p-value of one in a million.
std::string assess(const Parameters& parameters) {
  std::vector<FrameEvidence> frames(2);
  frames[1].stamp = 1'000'000'000;
  frames[1].travelled = 10.0;
  TestResults results;
  results.tests = {{"a", {frames[0].stamp, frames[1].stamp}, 20.0, 100.0, 1e-6, "It differs.", "Repair it."}};
  std::ostringstream text;
  text.precision(17);
  for (const FrameTrust& frame : assessFrames(frames, results, false, parameters))
    text << toString(frame.state) << " " << frame.probabilities[1] << "\n";
  return text.str();
}

TEST(ParameterEffects, EachParameterChangesTheAssessment) {
  EXPECT_EQ(urban_nav_core::testing::findParametersWithoutEffect(
                table(), {{"failed test", assess, {{"false_alarm", 1e-9}, {"unexplained_drift", 1.0}}}}),
            "");
}

}  // namespace
}  // namespace urban_nav_trust
