// SPDX-License-Identifier: BSD-3-Clause
#include "folder/euroc_table.hpp"

#include <gtest/gtest.h>

#include <string>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

EurocTable read(const std::string& text) {
  const testing::TemporaryFolder folder;
  testing::writeFile(folder.file("data.csv"), text);
  return readEurocTable(folder.file("data.csv"), 2, "stamp in ns, file name");
}

TEST(EurocTable, NeedsNoHeader) {
  for (const char* const header : {"", "#timestamp [ns],filename\n", "timestamp,filename\r\n", "# a comment\n\n"}) {
    const EurocTable table = read(std::string(header) + "10,a.png\n20,b.png\r\n");
    ASSERT_EQ(table.rows.size(), 2U) << header;
    EXPECT_EQ(table.rows[0].stamp, 10);
    EXPECT_EQ(table.rows[1].cells[1], "b.png");
    EXPECT_EQ(table.out_of_order + table.repeated, 0U);
  }
}

TEST(EurocTable, IsSortedAndCounted) {
  const EurocTable table = read("#t,f\n30,c\n10,a\n20,b\n10,again\n");
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0].cells[1], "a");
  EXPECT_EQ(table.rows[2].cells[1], "c");
  EXPECT_EQ(table.out_of_order, 2U);
  EXPECT_EQ(table.repeated, 1U);
}

TEST(EurocTable, SecondsAreRecognisedWhateverTheHeaderStates) {
  for (const char* const header : {"", "#timestamp [ns],filename\n", "#timestamp [s],filename\n"}) {
    const EurocTable table = read(std::string(header) + "1500000000.000000000,a.png\n1500000000.100000000,b.png\n");
    ASSERT_EQ(table.rows.size(), 2U) << header;
    EXPECT_EQ(table.rows[1].stamp, 1500000000100000000);
    EXPECT_EQ(table.unit, 1.0);
  }
}

TEST(EurocTable, NamesWhatIsWrong) {
  EXPECT_THROW(read("10,a\nx,b\n"), urban_nav_core::UserError);
  EXPECT_THROW(read("10\n"), urban_nav_core::UserError);
  EXPECT_THROW(read("t,f\nt,f\n"), urban_nav_core::UserError);
  EXPECT_THROW(read("10,a\n").rows[0].number(1), urban_nav_core::UserError);
}

}  // namespace
}  // namespace urban_nav_input
