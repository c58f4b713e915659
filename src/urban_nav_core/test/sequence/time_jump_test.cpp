// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/time_jump.hpp"

#include <gtest/gtest.h>

namespace urban_nav_core {
namespace {

TEST(TimeJump, InputsThatOvertookEachOtherAreNone) {
  constexpr StampNs now = 1'225'719'873'501'685'001;
  EXPECT_FALSE(jumpsBack(now, now));
  EXPECT_FALSE(jumpsBack(now + 3'600'000'000'000, now)) << "a gap";
  EXPECT_FALSE(jumpsBack(now - 50'000'000, now));
  EXPECT_FALSE(jumpsBack(now - 1'000'000'000, now));
  EXPECT_TRUE(jumpsBack(now - 1'000'000'001, now));
  EXPECT_TRUE(jumpsBack(0, now));
}

}  // namespace
}  // namespace urban_nav_core
