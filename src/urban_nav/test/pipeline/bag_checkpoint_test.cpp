// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/bag_checkpoint.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

constexpr urban_nav_core::StampNs kEnd = 100'000'000'000;

TEST(BagState, ComesBack) {
  const BagState state{{"a", "b"}, kEnd, "reader", "vo"};
  const std::string bytes = packBagState(state);
  const BagState back = unpackBagState(bytes);
  EXPECT_EQ(back.bags, state.bags);
  EXPECT_EQ(back.receipt, kEnd);
  EXPECT_EQ(back.reader, "reader");
  EXPECT_EQ(back.vo, "vo");
  for (std::size_t i = 0; i < bytes.size(); ++i)
    EXPECT_THROW(unpackBagState(bytes.substr(0, i)), urban_nav_core::DataError) << i;
}

TEST(BagState, KnowsWhichBagsFollow) {
  const BagState state{{"a", "b"}, kEnd, "", ""};
  const auto behind = [&](const std::vector<std::string>& bags, double seconds) {
    return bagsBehind(state, bags, kEnd + static_cast<urban_nav_core::StampNs>(1e9 * seconds));
  };
  EXPECT_EQ(behind({"a", "b"}, -20.0), 2U);
  EXPECT_EQ(behind({"a", "b", "c"}, -20.0), 2U);
  EXPECT_EQ(behind({"b", "c"}, -10.0), 1U);
  EXPECT_EQ(behind({"c", "d"}, 0.1), 0U);
  EXPECT_EQ(behind({"c"}, 4.9), 0U);
  EXPECT_FALSE(behind({"c"}, 5.0));
  EXPECT_FALSE(behind({"c"}, 0.0)) << "recorded at the same time";
  EXPECT_FALSE(behind({"a"}, -20.0)) << "the one after it is missing";
  EXPECT_FALSE(behind({}, 1.0)) << "a folder";
}

}  // namespace
}  // namespace urban_nav
