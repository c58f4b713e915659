// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/deflate.hpp"

#include <gtest/gtest.h>

#include "support/contents.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {
namespace {

TEST(Deflate, RoundTrip) {
  testing::Drawn drawn(1);
  for (const std::string& bytes : {std::string(), std::string("x"), std::string(100000, '\0'), drawn.bytes(100000)})
    EXPECT_EQ(inflated(deflated(bytes), 100000), bytes);
  EXPECT_LT(deflated(std::string(100000, '\0')).size(), 1000U);
}

TEST(Deflate, RefusesWhatIsTooLongOrNoSuchThing) {
  const std::string bytes = deflated(std::string(1000, 'x'));
  EXPECT_FALSE(inflated(bytes, 999));
  EXPECT_FALSE(inflated(bytes.substr(0, bytes.size() - 1), 1000));
  EXPECT_FALSE(inflated("", 1000));
  EXPECT_FALSE(inflated(std::string(7, '\0'), 1000));
  std::string lies = bytes;
  lies[4] = 1;  // a length of 4 GB for a few bytes
  EXPECT_FALSE(inflated(lies, ~std::size_t{0}));
}

TEST(Deflate, SurvivesAnything) {
  testing::Drawn drawn(1);
  const auto result =
      urban_nav_core::testing::fuzzText({deflated("words"), deflated(drawn.bytes(300))}, [](const std::string& text) {
        const auto bytes = inflated(text, 1 << 20);
        if (!bytes) throw urban_nav_core::DataError("x", "refused", "");
      });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

}  // namespace
}  // namespace urban_nav_store
