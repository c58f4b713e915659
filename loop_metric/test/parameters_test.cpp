// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/parameters.hpp"

#include <gtest/gtest.h>

#include "../nodelet/nodelet_parameters.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/parameters/sources.hpp"

namespace loop_metric {
namespace {

using urban_nav_core::insertMarkdown;
using urban_nav_core::readTextFile;

// Texts are made from the tables: `ninja loop_metric_documents` writes them anew.

TEST(Parameters, theYamlFileIsTheTable) {
  EXPECT_EQ(readTextFile("config/loop_metric.yaml"), printYaml(table().stage(), table().rows()));
}

TEST(Parameters, theReadmeShowsTheTables) {
  const std::string readme = readTextFile("README.md");
  EXPECT_EQ(readme, insertMarkdown(readme, "README.md", table().stage(), table().rows()));
  EXPECT_EQ(readme, insertMarkdown(readme, "README.md", nodeletTable().stage(), nodeletTable().rows()));
}

TEST(Parameters, noRowOfTheNodeletHidesOneOfTheStage) {
  for (const auto& own : nodeletTable().rows())
    for (const auto& row : table().rows()) EXPECT_NE(own.name, row.name);
}

TEST(Parameters, everyRowSaysWhatItDoesAndWhereItComesFrom) {
  for (const auto& row : table().rows()) {
    EXPECT_FALSE(row.sentence.empty()) << row.name;
    EXPECT_FALSE(row.source.empty()) << row.name;
    EXPECT_TRUE(isAllowed(row, row.standard)) << row.name;
  }
}

}  // namespace
}  // namespace loop_metric
