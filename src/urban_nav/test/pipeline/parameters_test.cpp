// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/parameters.hpp"

#include <gtest/gtest.h>

namespace urban_nav {
namespace {

AllParameters loaded(const std::vector<std::string>& settings) {
  return loadParameters(Arguments({{"set", settings}}));
}

TEST(Parameters, DefaultsNeedNoWarning) { EXPECT_TRUE(loaded({}).warnings.empty()); }

TEST(Parameters, StagesThatAreToldDifferentCamerasAreNamed) {
  const AllParameters differ = loaded({"swf_vo.disparity_offset=0.3"});
  ASSERT_EQ(differ.warnings.size(), 1U);
  for (const char* part : {"swf_vo.disparity_offset = 0.3", "loop_metric.disparity_offset = 0.1"})
    EXPECT_NE(differ.warnings[0].find(part), std::string::npos) << differ.warnings[0];
  EXPECT_TRUE(loaded({"swf_vo.disparity_offset=0.3", "loop_metric.disparity_offset=0.3"}).warnings.empty());
  EXPECT_TRUE(loaded({"swf_vo.iterations=5"}).warnings.empty()) << "the same word for another thing";
}

TEST(Parameters, MotionInputIsUnderstoodUnderTheNameOfTheStageThatHadIt) {
  const AllParameters old = loaded({"swf_vo.motion_input=wheels"});
  EXPECT_EQ(old.input.parameters.motion_input, "wheels");
  ASSERT_EQ(old.warnings.size(), 1U);
  EXPECT_NE(old.warnings[0].find("input.motion_input"), std::string::npos) << old.warnings[0];
  EXPECT_TRUE(loaded({"input.motion_input=wheels"}).warnings.empty());
}

}  // namespace
}  // namespace urban_nav
