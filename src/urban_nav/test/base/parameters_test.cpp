// SPDX-License-Identifier: BSD-3-Clause
#include "base/parameters.hpp"

#include <gtest/gtest.h>

#include "commands/stages.hpp"
#include "loop_metric/parameters.hpp"
#include "urban_nav_input/session/input_parameters.hpp"
#include "urban_nav_localization/parameters.hpp"
#include "urban_nav_registration/parameters.hpp"

namespace urban_nav {
namespace {

ParameterSet loaded(const std::vector<std::string>& settings) {
  return loadParameters(Arguments({{"set", settings}}, addStageTables));
}

std::vector<std::string> warningsOn(const std::vector<std::string>& settings) {
  return parameterWarnings(loaded(settings));
}

TEST(Parameters, DefaultsNeedNoWarning) { EXPECT_TRUE(warningsOn({}).empty()); }

TEST(Parameters, StagesWithDifferentCamerasAreNamed) {
  const std::vector<std::string> differ = warningsOn({"swf_vo.disparity_offset=0.3"});
  ASSERT_EQ(differ.size(), 1U);
  for (const char* part : {"swf_vo.disparity_offset = 0.3", "registration.disparity_offset = 0.1"})
    EXPECT_NE(differ[0].find(part), std::string::npos) << differ[0];
  EXPECT_TRUE(warningsOn({"swf_vo.disparity_offset=0.3", "registration.disparity_offset=0.3"}).empty());
  EXPECT_TRUE(warningsOn({"swf_vo.iterations=5"}).empty()) << "the same word for another thing";
}

TEST(Parameters, ParametersThatLeftLoopMetricAreUnderstoodByTheirOldNames) {
  const ParameterSet moved = loaded({"loop_metric.voxel=0.5", "loop_metric.map_sigma=0.2", "loop_metric.view_way=3"});
  EXPECT_EQ(moved.get(urban_nav_registration::table()).voxel_size, 0.5);
  EXPECT_EQ(moved.get(urban_nav_localization::table()).map_sigma, 0.2);
  EXPECT_EQ(moved.get(loop_metric::table()).keyframe_search_distance, 3.0);
  const std::vector<std::string> warnings = parameterWarnings(moved);
  ASSERT_EQ(warnings.size(), 3U);
  EXPECT_NE(warnings[0].find("registration.voxel_size"), std::string::npos) << warnings[0];
}

TEST(Parameters, MotionInputIsUnderstoodUnderTheNameOfTheStageThatHadIt) {
  const ParameterSet old = loaded({"swf_vo.motion_input=wheels"});
  EXPECT_EQ(old.get(urban_nav_input::inputTable()).motion_input, "wheels");
  ASSERT_EQ(parameterWarnings(old).size(), 1U);
  EXPECT_NE(parameterWarnings(old)[0].find("input.motion_input"), std::string::npos) << parameterWarnings(old)[0];
  EXPECT_TRUE(warningsOn({"input.motion_input=wheels"}).empty());
}

}  // namespace
}  // namespace urban_nav
