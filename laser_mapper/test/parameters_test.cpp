// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/parameters.hpp"

#include <gtest/gtest.h>

#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/parameter_tables.hpp"

namespace laser_mapper {
namespace {

TEST(Parameters, YamlAndReadmeEqualTheTable) {
  EXPECT_EQ(urban_nav_core::testing::findFaults(table().stage(), table().rows(), nodeletTable().rows()), "");
}

TEST(Parameters, TheYamlFileGivesTheDefaults) {
  const auto loaded = load(table(), urban_nav_core::readParameters("config/laser_mapper.yaml"));
  const Parameters defaults;
  for (const auto& row : table().rows())
    EXPECT_EQ(printValue(table().get(loaded.parameters, row.name)), printValue(table().get(defaults, row.name)))
        << row.name;
}

}  // namespace
}  // namespace laser_mapper
