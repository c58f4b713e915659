// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_localization/parameters.hpp"

#include <gtest/gtest.h>

#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/testing/parameter_tables.hpp"

namespace urban_nav_localization {
namespace {

TEST(Parameters, YamlAndReadmeMatchTheTables) {
  EXPECT_EQ(urban_nav_core::testing::findFaults(table().stage(), table().rows(), nodeletTable().rows()), "");
}

}  // namespace
}  // namespace urban_nav_localization
