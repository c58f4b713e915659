// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/csv.hpp"

#include <cmath>
#include <stdexcept>

#include "io/reader_check.hpp"

namespace urban_nav_core {
namespace {

const char* const kTable = "a,b, c\n1,2.5,x\n\n-3, 4e1 ,\"x, \"\"y\"\"\"\r\n";

TEST(Csv, ParsesItsCells) {
  const CsvTable table = CsvTable::parse(kTable, "t.csv");
  EXPECT_EQ(table.header(), (std::vector<std::string>{"a", "b", "c"}));
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.integer(1, table.column("a")), -3);
  EXPECT_EQ(table.number(1, table.column("b")), 40.0);
  EXPECT_EQ(table.text(1, table.column("c")), "x, \"y\"");
  EXPECT_EQ(table.where(1), "t.csv:4");
  EXPECT_TRUE(table.has("c"));
  EXPECT_FALSE(table.has("d"));
}

TEST(Csv, TakesAHeaderAfterAHash) {
  const CsvTable table =
      CsvTable::parse("#timestamp [ns],filename\n1403715273262142976,1403715273262142976.png\n", "data.csv");
  EXPECT_EQ(table.integer(0, table.column("timestamp [ns]")), 1403715273262142976);
}

TEST(Csv, NamesFileLineAndColumn) {
  const CsvTable table = CsvTable::parse(kTable, "t.csv");
  EXPECT_EQ(catchError([&] { (void)table.number(0, 2); }), "t.csv:2: c = `x`: expected a finite number");
  EXPECT_EQ(catchError([&] { (void)table.integer(0, 1); }), "t.csv:2: b = `2.5`: expected a whole number");
  EXPECT_EQ(catchError([&] { (void)table.column("d"); }),
            "t.csv: has no column `d`: expected a header with it; found: a,b,c");
  EXPECT_EQ(catchError([] { CsvTable::parse("a,b\n1\n", "t.csv"); }), "t.csv:2: 1 cells: expected 2, as in the header");
  EXPECT_EQ(catchError([] { CsvTable::parse("a,b\n1,\"2\n", "t.csv"); }), "t.csv:2: unterminated quote");
  EXPECT_EQ(catchError([] { CsvTable::parse("a,b\n1,\"2\"3\n", "t.csv"); }),
            "t.csv:2: text after a quote: expected a separator");
  EXPECT_EQ(catchError([] { CsvTable::parse("\n", "t.csv"); }), "t.csv: is empty: expected a header line and rows");
}

TEST(Csv, WhatIsPrintedReadsBack) {
  const std::vector<std::string> cells = {"plain", "a,b", "say \"no\"", "", " blank "};
  const CsvTable table = CsvTable::parse("a,b,c,d,e\n" + printCsvRow(cells), "t.csv");
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(table.text(0, i), cells[i]);
  EXPECT_EQ(printCsvRow({"1", "2"}), "1,2\n");
  EXPECT_EQ(CsvTable::parse("a,b\n" + printCsvRow({"#1", "2"}), "t.csv").text(0, 0), "#1");  // no comment
}

TEST(Csv, Fuzzed) {
  expectSurvives(testing::fuzzText({kTable, "a,b,c\n1,2,3\n"}, [](const std::string& text) {
    const CsvTable table = CsvTable::parse(text, "t");
    for (std::size_t i = 0; i < table.rows(); ++i) {
      if (!std::isfinite(table.number(i, 0))) throw std::runtime_error("a number that is not finite");
    }
  }));
}

}  // namespace
}  // namespace urban_nav_core
