// SPDX-License-Identifier: BSD-3-Clause
#include "swf_vo/parameters.hpp"

#include <gtest/gtest.h>

#include "../nodelet/nodelet_parameters.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/types/error.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::insertMarkdown;
using urban_nav_core::parseSetting;
using urban_nav_core::readTextFile;

// Tests run in the folder of the package. What differs is written anew by the build target swf_vo_documents.

TEST(Parameters, theYamlFileIsTheTable) {
  EXPECT_EQ(readTextFile("config/swf_vo.yaml"), printYaml(table().stage(), table().rows()));
}

TEST(Parameters, theReadmeShowsTheTables) {
  const std::string readme = readTextFile("README.md");
  EXPECT_EQ(readme, insertMarkdown(readme, "README.md", table().stage(), table().rows()));
  EXPECT_EQ(readme, insertMarkdown(readme, "README.md", nodeletTable().stage(), nodeletTable().rows()));
}

TEST(Parameters, theYamlFileGivesTheDefaults) {
  const auto loaded = load(table(), urban_nav_core::readParameters("config/swf_vo.yaml"));
  const Parameters defaults;
  for (const auto& row : table().rows())
    EXPECT_EQ(printValue(table().get(loaded.parameters, row.name)), printValue(table().get(defaults, row.name)))
        << row.name;
}

TEST(Parameters, everyRowSaysWhatItDoesAndWhereItComesFrom) {
  for (const auto& row : table().rows()) {
    EXPECT_FALSE(row.sentence.empty()) << row.name;
    EXPECT_FALSE(row.source.empty()) << row.name;
    EXPECT_TRUE(isAllowed(row, row.standard)) << row.name;
  }
  for (const auto& row : nodeletTable().rows()) EXPECT_TRUE(isAllowed(row, row.standard)) << row.name;
}

TEST(Parameters, noRowOfTheNodeletHidesOneOfTheFilter) {
  for (const auto& own : nodeletTable().rows())
    for (const auto& row : table().rows()) EXPECT_NE(own.name, row.name);
}

TEST(Parameters, aValueOutOfRangeIsNamedWithWhatIsAllowed) {
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
