// SPDX-License-Identifier: BSD-3-Clause
#include "swf_vo/parameters.hpp"

#include <gtest/gtest.h>

#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/parameter_tables.hpp"
#include "urban_nav_core/types/error.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::parseSetting;

TEST(Parameters, YamlAndReadmeMatchTheTables) {
  EXPECT_EQ(urban_nav_core::testing::findFaults(table().stage(), table().rows(), nodeletTable().rows()), "");
}

TEST(Parameters, TheYamlFileGivesTheDefaults) {
  const auto loaded = load(table(), urban_nav_core::readParameters("config/swf_vo.yaml"));
  const Parameters defaults;
  for (const auto& row : table().rows())
    EXPECT_EQ(printValue(table().get(loaded.parameters, row.name)), printValue(table().get(defaults, row.name)))
        << row.name;
}

TEST(Parameters, AValueOutOfRangeIsNamedWithWhatIsAllowed) {
  try {
    load(table(), {parseSetting("swf_vo.window=0")});
    FAIL();
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find("swf_vo.window"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("1...100000 (frames)"), std::string::npos) << error.what();
  }
  EXPECT_THROW(load(table(), {parseSetting("swf_vo.windw=5")}), urban_nav_core::UserError);
}

}  // namespace
}  // namespace swf_vo
