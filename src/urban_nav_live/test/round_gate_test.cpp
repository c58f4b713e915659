// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/round_gate.hpp"

#include <gtest/gtest.h>

#include <string>

namespace urban_nav_live {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs kGateSecond = 1'000'000'000;

/// Gate of text items, which records all delivered items; | marks a new round.
struct Gate {
  explicit Gate(std::set<int> leading, StampNs patience = 2 * kGateSecond)
      : gate({std::move(leading), patience, 4},
             {[this](std::string& word) { text += word; }, [this] { text += "|"; }}) {}
  void add(int stream, double seconds, const std::string& word) {
    gate.add(stream, static_cast<StampNs>(seconds * 1e9), word);
  }
  std::string text;
  RoundGate<std::string> gate;
};

TEST(RoundGate, AJumpOfAllStreamsIsOneNewRoundWhateverOvertakesWhat) {
  Gate left_first({0, 1}), right_late({0, 1});
  for (Gate* each : {&left_first, &right_late}) {
    each->add(0, 10.0, "a");
    each->add(1, 10.0, "A");
  }
  left_first.add(0, 3.0, "c");
  left_first.add(1, 10.1, "B");  // of the ending round
  left_first.add(1, 3.0, "C");
  left_first.add(0, 3.1, "d");
  EXPECT_EQ(left_first.text, "aAB|cCd");
  EXPECT_EQ(left_first.gate.round(), 1);

  right_late.add(0, 3.0, "c");
  right_late.add(0, 3.1, "d");
  right_late.add(1, 3.0, "C");
  right_late.add(1, 3.1, "D");
  EXPECT_EQ(right_late.text, "aA|cdCD");
  EXPECT_EQ(right_late.gate.dropped(), 0);
}

TEST(RoundGate, AStreamThatIsSilentDelaysTheNextRoundByThePatience) {
  Gate gate({0, 1});
  gate.add(0, 10.0, "a");
  gate.add(1, 10.0, "A");
  gate.add(0, 3.0, "b");
  gate.add(0, 4.0, "c");
  EXPECT_EQ(gate.text, "aA");
  gate.add(0, 5.1, "d");
  EXPECT_EQ(gate.text, "aA|bcd");
  gate.add(1, 10.1, "B");
  EXPECT_EQ(gate.text, "aA|bcd") << "of the previous round";
  EXPECT_EQ(gate.gate.dropped(), 1);
  gate.add(1, 5.0, "C");
  EXPECT_EQ(gate.text, "aA|bcdC");
}

TEST(RoundGate, OthersFollowTheLeadingStream) {
  Gate gate({0});
  gate.add(1, 10.0, "A");
  gate.add(0, 9.0, "a");
  gate.add(1, 3.0, "B");
  EXPECT_EQ(gate.text, "Aa");
  gate.add(0, 9.5, "b");
  gate.add(0, 2.9, "c");
  gate.add(2, 3.1, "x");  // arrived when the others were in the next round
  EXPECT_EQ(gate.text, "Aab|Bcx");
}

TEST(RoundGate, AStreamThatMissedItsJumpComesAlong) {
  Gate gate({0});
  gate.add(0, 10.0, "a");
  gate.add(1, 6.5, "A");  // no further item until the clock jumps back
  gate.add(0, 6.0, "b");
  gate.add(0, 7.0, "c");
  gate.add(1, 6.9, "B");
  EXPECT_EQ(gate.text, "aA|bcB");
  gate.add(1, 1.0, "C");
  gate.add(0, 1.0, "d");
  EXPECT_EQ(gate.text, "aA|bcB|Cd") << "the next one is also a jump";
}

TEST(RoundGate, TwoJumpsAreTwoRounds) {
  Gate gate({0, 1});
  gate.add(0, 10.0, "a");
  gate.add(1, 10.0, "A");
  gate.add(0, 7.0, "b");
  gate.add(0, 4.0, "c");
  gate.add(1, 7.0, "B");
  EXPECT_EQ(gate.text, "aA|bB");
  gate.add(1, 4.0, "C");
  EXPECT_EQ(gate.text, "aA|bB|cC");
}

TEST(RoundGate, WhatWaitsIsBounded) {
  Gate gate({0}, 100 * kGateSecond);
  gate.add(0, 100.0, "a");
  gate.add(1, 100.0, "A");
  for (const char* word : {"1", "2", "3", "4", "5"}) gate.add(1, 1.0, word);
  EXPECT_EQ(gate.gate.dropped(), 1);
  gate.gate.flush();
  EXPECT_EQ(gate.text, "aA|2345");
}

}  // namespace
}  // namespace urban_nav_live
