// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/cloud/point_times.hpp"

#include <gtest/gtest.h>

namespace urban_nav_core {
namespace {

TEST(PointTimesTest, TextsAreReadBack) {
  for (const char* text : {"time,s,header", "t,ns,header", "offset_time,us,absolute", "a,b,ms,absolute", "none"}) {
    const std::optional<PointTimes> times = parsePointTimes(text);
    ASSERT_TRUE(times) << text;
    EXPECT_EQ(printPointTimes(*times), text);
  }
  EXPECT_EQ(parsePointTimes("a,b,ms,absolute")->field, "a,b");
}

TEST(PointTimesTest, OtherTextsAreRefused) {
  for (const char* text : {"", ",", ",,", "time", "time,s", "time,min,header", "time,s,end", ",s,header", "time,s,"})
    EXPECT_FALSE(parsePointTimes(text)) << text;
}

}  // namespace
}  // namespace urban_nav_core
