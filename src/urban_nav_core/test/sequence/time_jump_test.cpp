// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/time_jump.hpp"

#include <gtest/gtest.h>

namespace urban_nav_core {
namespace {

TEST(TimeJump, InputsThatOvertookEachOtherAreNone) {
  constexpr StampNs kNow = 1'225'719'873'501'685'001;
  EXPECT_FALSE(jumpsBack(kNow, kNow));
  EXPECT_FALSE(jumpsBack(kNow + 3'600'000'000'000, kNow)) << "a gap";
  EXPECT_FALSE(jumpsBack(kNow - 50'000'000, kNow));
  EXPECT_FALSE(jumpsBack(kNow - 1'000'000'000, kNow));
  EXPECT_TRUE(jumpsBack(kNow - 1'000'000'001, kNow));
  EXPECT_TRUE(jumpsBack(0, kNow));
}

}  // namespace
}  // namespace urban_nav_core
