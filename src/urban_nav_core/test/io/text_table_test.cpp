// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/text_table.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "io/reader_check.hpp"

namespace urban_nav_core {
namespace {

using Rows = std::vector<std::vector<std::string>>;

Rows listRows(const TextTable& table) {
  Rows rows;
  table.forEachRow([&rows](const TableRow& row) { rows.emplace_back(row.cells.begin(), row.cells.end()); });
  return rows;
}

Rows parse(const std::string& text) { return listRows(TextTable(text, "t")); }

TEST(TextTable, EverySeparatorGivesTheCells) {
  const Rows rows = {{"1", "2.5", "-3e1"}, {"4", "5.0", "6"}};
  for (const char* text :
       {"1,2.5,-3e1\n4,5.0,6\n", "1;2.5;-3e1\n4;5.0;6", "1\t2.5\t-3e1\n4\t5.0\t6\n", "1 2.5   -3e1\r\n 4 5.0 6 \r\n",
        "1, 2.5, -3e1\n4 ,5.0 , 6\n", "1;2,5;-3e1\n4;5,0;6\n", "1 2,5 -3e1\n4 5,0 6\n",
        "\"1\",\"2.5\",\"-3e1\"\n4,5.0,6\n", "# c\n\n1 2.5 -3e1 # a remark\n% c\n// c\n4 5.0 6\n",
        "sep=;\n1;2,5;-3e1\n4;5,0;6\n", "1,2.5,-3e1,\n4,5.0,6,\n"})
    EXPECT_EQ(parse(text), rows) << text;
}

TEST(TextTable, HeadersAreRowsOrComments) {
  for (const char* text : {"x,y z\n1,2\n", "#x,y z\n1,2\n", "// x, y z\n1,2\n",
                           "# made by a program\n\"x\",\"y z\"\n1,2\n", "x;y z\n1,0;2,0\n", "x,y z,\n1,2,\n"}) {
    const TextTable table(text, "t");
    ASSERT_GE(table.header().size(), 2U) << text;
    EXPECT_EQ(table.header()[0], "x") << text;
    EXPECT_EQ(table.header()[1], "y z") << text;
    EXPECT_EQ(listRows(table).size(), 1U) << text;
  }
  EXPECT_TRUE(TextTable("1,2\n3,4\n", "t").header().empty());
  EXPECT_TRUE(TextTable("nan,nan\n3,4\n", "t").header().empty());
  EXPECT_TRUE(TextTable("#a b\n1 2\n", "t").headerIsComment());
}

TEST(TextTable, TextWithOtherSeparatorsStaysInItsCell) {
  EXPECT_EQ(parse("name,reason\na 1,\"too few; weak, \"\"bad\"\"\"\nb 2,none; at all\n"),
            (Rows{{"a 1", "too few; weak, \"bad\""}, {"b 2", "none; at all"}}));
  EXPECT_EQ(parse("a\tb\tc\n1\t\t3\n"), (Rows{{"1", "", "3"}}));
}

TEST(TextTable, QuotedCellsBetweenCommasMayHaveDecimalCommas) {
  EXPECT_EQ(parse("\"1\",\"2,5\"\n\"4\",\"-5,125\"\n"), (Rows{{"1", "2.5"}, {"4", "-5.125"}}));
  EXPECT_EQ(parse("1.5,\"2,25\"\n2.5,\"3,75\"\n"), (Rows{{"1.5", "2,25"}, {"2.5", "3,75"}}))
      << "other cells have decimal points";
  EXPECT_EQ(parse("1,\"2,500\"\n4,\"5,125\"\n"), (Rows{{"1", "2,500"}, {"4", "5,125"}}))
      << "may be a thousands separator";
}

TEST(TextTable, NamesTheLineOfABrokenQuote) {
  EXPECT_EQ(catchError([] { parse("1,2\n3,\"4\n"); }), "t:2: unterminated quote");
}

TEST(TextTable, CellsAreNumbersOrNot) {
  EXPECT_EQ(parseCell("-1.5e3"), -1500.0);
  EXPECT_TRUE(std::isnan(parseCell("NaN").value()));
  EXPECT_TRUE(std::isinf(parseCell("-inf").value()));
  for (const char* text : {"", "x", "1,5", "0x10", "nano"}) EXPECT_FALSE(parseCell(text)) << text;
}

TEST(TextTable, SurvivesDamage) {
  expectSurvives(testing::fuzzText(
      {"sep=;\n\"a\";b\n1,5;2\n", "a\tb\n1\t\"2 \"\"x\"\n", "# x y\n1 2,5\n3 4 # c\n", "a,b,\n1,2,\r\n"},
      [](const std::string& text) {
        TextTable table(text, "t");
        table.requireHeader();
        for (const auto& row : listRows(table))
          if (row.empty()) throw std::runtime_error("a row without cells");
      }));
}

}  // namespace
}  // namespace urban_nav_core
