// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/parameters.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/parameter_tables.hpp"

namespace urban_nav_registration {
namespace {

TEST(Parameters, YamlAndReadmeMatchTheTables) {
  EXPECT_EQ(urban_nav_core::testing::findFaults(table().stage(), table().rows()), "");
}

}  // namespace
}  // namespace urban_nav_registration
