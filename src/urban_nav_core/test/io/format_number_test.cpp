// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/format_number.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_core {

TEST(FormatNumber, KeepsSignificantDigitsWithoutTrailingZeros) {
  EXPECT_EQ(formatNumber(0.0), "0");
  EXPECT_EQ(formatNumber(12.3456), "12.3");
  EXPECT_EQ(formatNumber(0.00123456, 2), "0.0012");
  EXPECT_EQ(formatNumber(1.5, 6), "1.5");
  EXPECT_EQ(formatNumber(-2.0), "-2");
  EXPECT_EQ(formatNumber(123456.7), "123457") << "all digits before the point are kept";
}

TEST(FormatNumber, UsesAnExponentOnlyForExtremes) {
  EXPECT_EQ(formatNumber(1e-5, 1), "0.00001");
  EXPECT_EQ(formatNumber(2.5e-7), "2.5e-07");
  EXPECT_EQ(formatNumber(3e12), "3e+12");
}

TEST(FormatNumber, MarksValuesThatAreNotFinite) {
  EXPECT_EQ(formatNumber(std::nan("")), "–");
  EXPECT_EQ(formatNumber(-INFINITY), "–");
}

}  // namespace urban_nav_core
