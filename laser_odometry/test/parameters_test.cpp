// SPDX-License-Identifier: BSD-3-Clause
#include "laser_odometry/parameters.hpp"

#include <gtest/gtest.h>

#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/parameter_tables.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_odometry {
namespace {

using urban_nav_core::parseSetting;

TEST(Parameters, YamlAndReadmeMatchTheTables) {
  EXPECT_EQ(urban_nav_core::testing::findFaults(table().stage(), table().rows(), nodeletTable().rows()), "");
}

TEST(Parameters, TheYamlFileGivesTheDefaults) {
  const auto loaded = load(table(), urban_nav_core::readParameters("config/laser_odometry.yaml"));
  const Parameters defaults;
  for (const auto& row : table().rows())
    EXPECT_EQ(printValue(table().get(loaded.parameters, row.name)), printValue(table().get(defaults, row.name)))
        << row.name;
}

TEST(Parameters, AValueOutOfRangeIsNamedWithWhatIsAllowed) {
  try {
    load(table(), {parseSetting("laser_odometry.cell=0")});
    FAIL();
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find("laser_odometry.cell"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("0.1...5 (m)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace laser_odometry
