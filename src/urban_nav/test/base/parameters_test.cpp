// SPDX-License-Identifier: BSD-3-Clause
#include "base/parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "commands/stages.hpp"
#include "loop_metric/parameters.hpp"
#include "map/map_command.hpp"
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

/// Parameters that a text lists: "swf_vo.window" of "  swf_vo.window = 10  (default)".
std::vector<std::string> listedParameters(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t equals = line.find(" = "), origin = line.find("  (", 2);
    const bool is_parameter = line.size() > 2 && line.substr(0, 2) == "  " && line[2] != ' ' && equals < origin &&
                              origin != std::string::npos;
    if (is_parameter) names.push_back(line.substr(2, equals - 2));
  }
  return names;
}

std::string helpOfMap(const char* option) {
  const std::vector<const char*> words = {"urban_nav", "map", option};
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(runCommandLine({mapCommand(makeStages)}, addStageTables, static_cast<int>(words.size()), words.data()), 0);
  return ::testing::internal::GetCapturedStdout();
}

TEST(Parameters, HelpOfMapIsShortAndListsThoseForUsersInTheOrderOfTheStages) {
  const std::string help = helpOfMap("--help");
  const std::vector<std::string> listed = listedParameters(help);
  EXPECT_LT(std::count(help.begin(), help.end(), '\n'), 160);
  EXPECT_LE(listed.size(), 60U);
  EXPECT_GE(listed.size(), 40U);
  EXPECT_NE(help.find("--help-all"), std::string::npos);
  const auto first = std::find_if(listed.begin(), listed.end(), [](const std::string& name) {
    return name.find('.') != std::string::npos && name.rfind("input.", 0) != 0;
  });
  ASSERT_NE(first, listed.end());
  EXPECT_EQ(first->rfind("swf_vo.", 0), 0U) << *first;
  EXPECT_EQ(std::count(listed.begin(), listed.end(), "scene_labeler.samples"), 0) << "of training alone";
}

TEST(Parameters, HelpAllOfMapListsEveryOne) {
  std::vector<std::string> names;
  for (const urban_nav_core::Setting& setting : loaded({}).settings())
    names.push_back(urban_nav_core::fullName(setting.stage, setting.name));
  EXPECT_EQ(listedParameters(helpOfMap("--help-all")), names);
}

}  // namespace
}  // namespace urban_nav
