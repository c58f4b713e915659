// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/cloud_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

using Values = std::vector<double>;

const char* const kColumnsPly =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty list uchar int faces\nproperty uchar "
    "label\nend_header\n1.5 2 7 7 3\n-2 0 4\n";

TEST(CloudColumns, AreFoundByNameInAnyOrder) {
  const auto columns = parseCloudColumns("label,y,x\n3,1,2\n\n4,nan,-1e2\r\n", "c", {"x", "label", "z", "y"});
  ASSERT_EQ(columns.size(), 4u);
  EXPECT_EQ(columns[0].value(), (Values{2.0, -100.0}));
  EXPECT_EQ(columns[1].value(), (Values{3.0, 4.0}));
  EXPECT_FALSE(columns[2].has_value());
  EXPECT_TRUE(std::isnan(columns[3].value()[1]));
}

TEST(CloudColumns, OfPlySkipListsAndOtherProperties) {
  const auto columns = parseCloudColumns(kColumnsPly, "c", {"label", "x", "faces"});
  EXPECT_EQ(columns[0].value(), (Values{3.0, 4.0}));
  EXPECT_EQ(columns[1].value(), (Values{1.5, -2.0}));
  EXPECT_FALSE(columns[2].has_value());
}

TEST(CloudColumns, RefuseWordsAndRowsOfAnotherLengthWithTheirLine) {
  for (const char* text : {"x,y\n1,2\n1,two\n", "x,y\n1,2\n1\n", "x,y\n1,2\n1,2,3\n"}) try {
      parseCloudColumns(text, "c.csv", {"x", "y"});
      FAIL() << text;
    } catch (const UserError& error) {
      EXPECT_EQ(error.parts().where, "c.csv:3");
    }
}

TEST(CloudColumns, SurviveDamage) {
  const auto result = testing::fuzzText({kColumnsPly, "x,y,label\n1,2,3\n4,5,6\n"}, [](const std::string& text) {
    const auto columns = parseCloudColumns(text, "c", {"x", "label"});
    if (!columns[0] || !columns[1]) return;
    EXPECT_EQ(columns[0]->size(), columns[1]->size());
  });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
}

}  // namespace
}  // namespace urban_nav_core
