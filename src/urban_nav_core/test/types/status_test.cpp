// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/status.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace urban_nav_core {
namespace {

TEST(Health, PrintsAndReadsBack) {
  for (const Health health : {Health::Ok, Health::Degraded, Health::Lost, Health::Recovered}) {
    EXPECT_EQ(parseHealth(toString(health)), health);
  }
  EXPECT_STREQ(toString(Health::Degraded), "DEGRADED");
  EXPECT_FALSE(parseHealth("ok"));
  EXPECT_FALSE(parseHealth(""));
}

TEST(Status, PrintsItsSentence) {
  std::ostringstream out;
  out << Status{Health::Lost, 2, "the left image is dark"} << " / " << Status{};
  EXPECT_EQ(out.str(), "LOST: the left image is dark / OK");
}

TEST(Status, ComparesAllItsParts) {
  const Status status{Health::Lost, 2, "dark"};
  EXPECT_EQ(status, (Status{Health::Lost, 2, "dark"}));
  EXPECT_FALSE(status == (Status{Health::Ok, 2, "dark"}));
  EXPECT_FALSE(status == (Status{Health::Lost, 3, "dark"}));
  EXPECT_FALSE(status == (Status{Health::Lost, 2, "blurred"}));
}

}  // namespace
}  // namespace urban_nav_core
