// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/input_gate.hpp"

#include <gtest/gtest.h>

namespace urban_nav_live {
namespace {

TEST(InputGate, CountsWhatAPauseDrops) {
  InputGate gate;
  EXPECT_TRUE(gate.pass());
  gate.pause();
  EXPECT_TRUE(gate.isPaused());
  EXPECT_FALSE(gate.pass());
  EXPECT_FALSE(gate.pass());
  gate.resume();
  EXPECT_TRUE(gate.pass());
  gate.countInvalid();
  EXPECT_EQ(gate.counts().paused_dropped, 2);
  EXPECT_EQ(gate.counts().invalid, 1);
}

}  // namespace
}  // namespace urban_nav_live
