// SPDX-License-Identifier: BSD-3-Clause
#include "blocks/event_block.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {
namespace {

std::vector<InputEvent> someEvents() {
  std::vector<InputEvent> events;
  for (int i = 0; i < 500; ++i) {
    events.push_back({i % 3 == 0   ? "stereo"
                      : i % 3 == 1 ? "laser_left"
                                   : "",
                      1225719873501685123 + 13'000'000LL * i, i % 5 != 0});
  }
  events.push_back({"stereo", -5, true});  // a clock that jumped
  return events;
}

TEST(EventBlock, RoundTripIsExact) {
  EXPECT_EQ(unpackEvents(packEvents(someEvents())), someEvents());
  EXPECT_EQ(unpackEvents(packEvents({})), std::vector<InputEvent>());
}

TEST(EventBlock, SurvivesAnything) {
  std::vector<InputEvent> few = someEvents();
  few.resize(5);
  const std::string plain = *inflated(packEvents(few), 1 << 20);
  for (const bool inside : {false, true}) {
    const auto result =
        urban_nav_core::testing::fuzzText({inside ? plain : packEvents(few)}, [&](const std::string& text) {
          if (!unpackEvents(inside ? deflated(text) : text)) throw urban_nav_core::DataError("x", "refused", "");
        });
    EXPECT_EQ(result.failure, "");
    EXPECT_GT(result.accepted, 0);
    EXPECT_GT(result.refused, 0);
  }
}

}  // namespace
}  // namespace urban_nav_store
