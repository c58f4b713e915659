// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/stamp.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace urban_nav_core {
namespace {

TEST(Stamp, PrintsNineDecimals) {
  EXPECT_EQ(printStamp(0), "0.000000000");
  EXPECT_EQ(printStamp(1225719873501685000), "1225719873.501685000");
  EXPECT_EQ(printStamp(-1), "-0.000000001");
  EXPECT_EQ(printStamp(-3466000000), "-3.466000000");
  EXPECT_EQ(printStamp(std::numeric_limits<StampNs>::min()), "-9223372036.854775808");
}

TEST(Stamp, WhatIsPrintedReadsBack) {
  for (const StampNs stamp : {StampNs{0}, StampNs{1}, StampNs{-1}, StampNs{1225719873501685123}, StampNs{-3466000000},
                              std::numeric_limits<StampNs>::max()}) {
    EXPECT_EQ(parseStamp(printStamp(stamp)), stamp);
  }
}

TEST(Stamp, ReadsDecimalSeconds) {
  EXPECT_EQ(parseStamp("61.59"), 61590000000);
  EXPECT_EQ(parseStamp("+2"), 2000000000);
  EXPECT_EQ(parseStamp(".5"), 500000000);
  EXPECT_EQ(parseStamp("7."), 7000000000);
  EXPECT_EQ(parseStamp("1225719873.50240921974182"), 1225719873502409220);
  EXPECT_EQ(parseStamp("-0.0000000005"), -1);
  EXPECT_EQ(parseStamp("0.0000000004999"), 0);
  EXPECT_EQ(parseStamp("0.9999999995"), 1000000000);
}

TEST(Stamp, RefusesWhatIsNoDecimalOrDoesNotFit) {
  for (const char* text : {"", "-", ".", "+.", "1e-1", "1.2.3", " 1", "1 ", "nan", "0x1", "9223372036.854775808",
                           "99999999999999999999999", "9223372036.8547758075", "--1"}) {
    EXPECT_FALSE(parseStamp(text)) << text;
  }
}

TEST(Stamp, DifferenceIsExactWhereADoubleOfTheEpochIsNot) {
  EXPECT_EQ(secondsBetween(1225719873501685000, 1225719873501685001), 1e-9);
  EXPECT_EQ(secondsBetween(5, 2), -3e-9);
  EXPECT_NEAR(secondsBetween(std::numeric_limits<StampNs>::min(), std::numeric_limits<StampNs>::max()),
              1.8446744073709552e10, 1.0);
}

}  // namespace
}  // namespace urban_nav_core
