// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/numbers.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace urban_nav_core {
namespace {

double fromBits(std::uint64_t bits) {
  double value = 0.0;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

TEST(Numbers, PrintTheShortestFormThatReadsBack) {
  EXPECT_EQ(printNumber(0.1), "0.1");
  EXPECT_EQ(printNumber(1.0), "1");
  EXPECT_EQ(printNumber(-2.5e-9), "-2.5e-09");
  EXPECT_EQ(printNumber(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(printNumber(0.1F), "0.1");
  EXPECT_EQ(printNumber(0.1 + 0.2), "0.30000000000000004");
}

TEST(Numbers, EveryFiniteNumberReadsBackToTheLastBit) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double value = fromBits(random());
    if (!std::isfinite(value)) continue;
    const auto back = parseNumber(printNumber(value));
    ASSERT_TRUE(back) << printNumber(value);
    ASSERT_EQ(std::memcmp(&value, &*back, sizeof(value)), 0) << printNumber(value);
  }
  for (const double value : {0.0, -0.0, std::numeric_limits<double>::min(), std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()}) {
    EXPECT_EQ(std::signbit(*parseNumber(printNumber(value))), std::signbit(value));
    EXPECT_EQ(*parseNumber(printNumber(value)), value);
  }
}

TEST(Numbers, DoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, locale) == nullptr) continue;
    EXPECT_EQ(printNumber(1.5), "1.5");
    EXPECT_EQ(parseNumber("1.5"), 1.5);
    EXPECT_FALSE(parseNumber("1,5"));
  }
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Numbers, ParseDecimals) {
  EXPECT_EQ(parseNumber("-1.5"), -1.5);
  EXPECT_EQ(parseNumber("+2e-3"), 2e-3);
  EXPECT_EQ(parseNumber("7.070912000000e+02"), 707.0912);
  EXPECT_EQ(parseNumber(".5"), 0.5);
  EXPECT_EQ(parseNumber("5."), 5.0);
  EXPECT_EQ(parseNumber("1e-400"), 0.0);
  EXPECT_EQ(parseNumber("-0.0000000000e-390"), 0.0);
  EXPECT_EQ(parseNumber(std::string(400, '0') + "1"), 1.0);
  EXPECT_EQ(parseNumber("0." + std::string(400, '0') + "1"), 0.0);
}

TEST(Numbers, RefuseWhatIsNoFiniteDecimal) {
  for (const char* text : {"",      " 1",  "1 ",  "nan", "inf", "-inf", "Infinity", "0x10", "1e999", "-1e999",
                           "1.2.3", "1,5", "--1", "+-1", "+",   "e5",   "1e",       ".",    "1_000", "1f"}) {
    EXPECT_FALSE(parseNumber(text)) << text;
  }
  EXPECT_FALSE(parseNumber("1" + std::string(400, '0')));
}

TEST(Numbers, ParseIntegers) {
  EXPECT_EQ(parseInteger("42"), 42);
  EXPECT_EQ(parseInteger("+42"), 42);
  EXPECT_EQ(parseInteger("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  for (const char* text : {"", "-", "4.0", "9223372036854775808", "1e3", " 1", "+-1"})
    EXPECT_FALSE(parseInteger(text)) << text;
}

TEST(Numbers, SplitLines) {
  using Pieces = std::vector<std::string_view>;
  EXPECT_EQ(splitBlanks("  a\tbc   d \r"), (Pieces{"a", "bc", "d"}));
  EXPECT_EQ(splitBlanks(" \t"), Pieces{});
  EXPECT_EQ(splitAt("a, b,,c ", ','), (Pieces{"a", "b", "", "c"}));
  EXPECT_EQ(splitAt("", ','), Pieces{""});
  EXPECT_EQ(splitAt(",", ','), (Pieces{"", ""}));
  EXPECT_EQ(trimmed(" \t a b \r"), "a b");
}

}  // namespace
}  // namespace urban_nav_core
