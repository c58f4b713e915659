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

}  // namespace
}  // namespace urban_nav
