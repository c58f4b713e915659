// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/parameters/table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "parameters/example_table.hpp"

namespace urban_nav_core {
namespace {

const RowInfo& row(const std::string& name) {
  for (const RowInfo& each : exampleTable().rows()) {
    if (each.name == name) return each;
  }
  throw std::out_of_range(name);
}

TEST(Table, GivesDefaultsAndTakesValues) {
  Example example;
  EXPECT_EQ(example.window, 10);
  EXPECT_EQ(example.noise, 0.3);
  EXPECT_TRUE(example.robust);
  EXPECT_EQ(example.forget, "schur");
  exampleTable().set(example, "window", 25);
  exampleTable().set(example, "noise", 2);  // a whole number serves as a number
  exampleTable().set(example, "forget", "delete");
  EXPECT_EQ(example.window, 25);
  EXPECT_EQ(example.noise, 2.0);
  EXPECT_EQ(std::get<std::int64_t>(exampleTable().get(example, "window")), 25);
  EXPECT_EQ(std::get<std::string>(exampleTable().get(example, "forget")), "delete");
}

TEST(Table, StatesTheAllowedValues) {
  EXPECT_EQ(allowed(row("window")), "1...100000 (frames)");
  EXPECT_EQ(allowed(row("noise")), "numbers 0.001...5 (px)");
  EXPECT_EQ(allowed(row("robust")), "true, false");
  EXPECT_EQ(allowed(row("forget")), "schur, delete");
  EXPECT_EQ(allowed(row("name")), "any text");
}

TEST(Table, ChecksTypesAndRanges) {
  EXPECT_TRUE(isAllowed(row("window"), 1));
  EXPECT_TRUE(isAllowed(row("window"), 100000));
  EXPECT_FALSE(isAllowed(row("window"), 0));
  EXPECT_FALSE(isAllowed(row("window"), 100001));
  EXPECT_FALSE(isAllowed(row("window"), 10.0));
  EXPECT_FALSE(isAllowed(row("window"), "10"));
  EXPECT_TRUE(isAllowed(row("noise"), 1));
  EXPECT_FALSE(isAllowed(row("noise"), std::nan("")));
  EXPECT_FALSE(isAllowed(row("noise"), INFINITY));
  EXPECT_FALSE(isAllowed(row("robust"), 1));
  EXPECT_FALSE(isAllowed(row("forget"), "keep"));
  EXPECT_TRUE(isAllowed(row("name"), "anything"));
}

TEST(Table, PrintsValuesAsYamlDoes) {
  EXPECT_EQ(printValue(true), "true");
  EXPECT_EQ(printValue(25), "25");
  EXPECT_EQ(printValue(0.3), "0.3");
  EXPECT_EQ(printValue("schur"), "schur");
  EXPECT_EQ(printValue("on"), "on");
  EXPECT_EQ(printValue("yes"), "\"yes\"");
  EXPECT_EQ(printValue(""), "\"\"");
  EXPECT_EQ(printValue("a b\n\"c\"\\"), "\"a b\\x0a\\\"c\\\"\\\\\"");
  EXPECT_EQ(printValue("12"), "\"12\"");
}

TEST(Table, NamesHaveTheirStageInFront) {
  EXPECT_EQ(fullName("swf_vo", "window"), "swf_vo.window");
  EXPECT_EQ(fullName("", "memory_mb"), "memory_mb");
}

}  // namespace
}  // namespace urban_nav_core
