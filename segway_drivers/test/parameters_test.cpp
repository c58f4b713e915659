// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/parameters.hpp"

#include <gtest/gtest.h>

#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/parameter_tables.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {
namespace {

TEST(Parameters, YamlAndReadmeEqualTheTable) {
  EXPECT_EQ(urban_nav_core::testing::findFaults(table().stage(), table().rows(), nodeletTable().rows()), "");
}

TEST(Parameters, ARowIsSetByDeviceAndKey) {
  const auto loaded = load(table(), {urban_nav_core::parseSetting("segway_drivers.lms291.latency_ms=2")});
  EXPECT_EQ(loaded.parameters.lms291_latency_ms, 2.0);
  EXPECT_THROW(load(table(), {urban_nav_core::parseSetting("segway_drivers.lms291.latency_ms=-1")}),
               urban_nav_core::UserError);
}

}  // namespace
}  // namespace segway_drivers
