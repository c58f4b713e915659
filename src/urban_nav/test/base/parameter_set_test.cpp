// SPDX-License-Identifier: BSD-3-Clause
#include "base/parameter_set.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::UserError;

struct Walls {
  double height;
  int number;
  Walls();
};
const urban_nav_core::Table<Walls>& walls() {
  static const urban_nav_core::Table<Walls> table(
      "walls", {{"height", &Walls::height, "m", 2.5, 0.1, 10.0, {}, "Height of a wall.", ""},
                {"number", &Walls::number, "", 4, 1, 100, {}, "Number of walls.", ""}});
  return table;
}
Walls::Walls() { walls().setDefaults(*this); }

struct Roof {
  std::string shape;
  Roof();
};
const urban_nav_core::Table<Roof>& roof() {
  static const urban_nav_core::Table<Roof> table(
      "roof", {{"shape", &Roof::shape, "", "flat", {}, {}, {"flat", "steep"}, "Shape of the roof.", ""}});
  return table;
}
Roof::Roof() { roof().setDefaults(*this); }

class ParameterSetTest : public ::testing::Test {
 protected:
  ParameterSetTest() {
    set.add(walls());
    set.add(roof());
    set.add(walls());  // of a second stage that uses the same table
  }
  ParameterSet set;
};

TEST_F(ParameterSetTest, HoldsEachTableOnceAndStartsWithDefaults) {
  EXPECT_EQ(set.settings().size(), 3U);
  EXPECT_EQ(set.settings("walls").size(), 2U);
  EXPECT_TRUE(set.settings("floor").empty());
  EXPECT_EQ(set.get(walls()).number, 4);
  EXPECT_EQ(set.get(roof()).shape, "flat");
}

TEST_F(ParameterSetTest, AssignsInOrderAndKeepsOrigins) {
  set.load({urban_nav_core::parseSetting("walls.height=3"), urban_nav_core::parseSetting("roof.shape=steep")});
  set.set("walls.height=4.5");
  EXPECT_EQ(set.get(walls()).height, 4.5);
  EXPECT_EQ(set.get(roof()).shape, "steep") << "set() keeps what was loaded";
  EXPECT_NE(set.toJson().print().find("\"roof.shape\": {\n    \"value\": \"steep\""), std::string::npos)
      << set.toJson().print();
  EXPECT_NE(set.help("roof", urban_nav_core::Audience::Experts).find("shape"), std::string::npos);
  EXPECT_EQ(set.help("roof", urban_nav_core::Audience::Experts).find("height"), std::string::npos);
  set.load({});
  EXPECT_EQ(set.get(walls()).height, 2.5) << "load() starts from the defaults";
}

TEST_F(ParameterSetTest, RefusesUnknownStagesRowsAndValues) {
  for (const char* bad : {"floor.height=1", "walls.colour=1", "walls.number=0", "roof.shape=round"})
    EXPECT_THROW(set.set(bad), UserError) << bad;
  EXPECT_EQ(set.get(walls()).number, 4);
}

}  // namespace
}  // namespace urban_nav
