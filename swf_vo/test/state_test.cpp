// SPDX-License-Identifier: BSD-3-Clause
// A filter that is made from the state of another goes on with its bits, wherever the cut is.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ablation/ablated.hpp"
#include "state/steps.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/error.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Archive;

std::string toBytes(Frame frame) {
  Archive archive;
  archive(frame);
  return archive.take();
}

std::string toBytes(std::vector<Settled> settled) {
  Archive archive;
  archive(settled);
  return archive.take();
}

std::string process(SwfVo& filter, const Step& step) { return toBytes(filter.process(step.frame.pair(), step.inputs)); }

/// Cuts a run everywhere in `cuts`, and has each part go on for some frames, one of them to the end.
void expectSeamless(const std::vector<Step>& some, const std::vector<std::size_t>& cuts,
                    const Parameters& parameters = Parameters(), const Ablation& ablation = Ablation()) {
  constexpr std::size_t kLongerThanTheWindow = 14;
  SwfVo whole = makeAblated(ablation, parameters, stereoCamera(), kPlace);
  std::vector<std::string> frames, states;
  for (const Step& step : some) {
    states.push_back(whole.state());
    frames.push_back(process(whole, step));
  }
  const std::string rest = toBytes(whole.flush());
  SwfVo unasked = makeAblated(ablation, parameters, stereoCamera(), kPlace);
  for (std::size_t i = 0; i < some.size(); ++i)
    ASSERT_TRUE(process(unasked, some[i]) == frames[i]) << "asking for the state changed frame " << i;

  for (const std::size_t cut : cuts) {
    SCOPED_TRACE("cut before frame " + std::to_string(cut));
    ASSERT_LT(cut, some.size());
    SwfVo part = makeAblated(ablation, parameters, stereoCamera(), kPlace, states[cut]);
    EXPECT_TRUE(part.state() == states[cut]);
    const bool to_the_end = cut == cuts[cuts.size() / 2];
    const std::size_t end = to_the_end ? some.size() : std::min(some.size(), cut + kLongerThanTheWindow);
    for (std::size_t i = cut; i < end; ++i) {
      ASSERT_TRUE(process(part, some[i]) == frames[i]) << "frame " << i;
      if (i + 1 < states.size()) {
        ASSERT_TRUE(part.state() == states[i + 1]) << "after frame " << i;
      }
    }
    if (end == some.size()) {
      EXPECT_TRUE(toBytes(part.flush()) == rest);
    }
  }
}

TEST(State, GoesOnWithTheSameBits) {
  expectSeamless(collectSteps("loop", 60, "black:1000:1"), {0, 1, 2, 3, 9, 12, 14, 30, 45});
}

TEST(State, GoesOnAtAStandstill) { expectSeamless(collectSteps("stand", 30, "black:1000:1"), {1, 8, 14, 20}); }

TEST(State, GoesOnInTheDark) { expectSeamless(collectSteps("loop", 60, "black:0.7:1.5"), {14, 15, 20, 30, 44, 46}); }

TEST(State, GoesOnInABlur) { expectSeamless(collectSteps("loop", 45, "blur:1:0.5"), {20, 22, 24, 30, 33}); }

TEST(State, ResumesAfterAGap) { expectSeamless(collectSteps("loop", 60, "drop:1:0.8"), {20, 21, 22, 24, 30}); }

TEST(State, GoesOnWithImagesExchanged) { expectSeamless(collectSteps("loop", 45, "swap:1:0.5"), {21, 23, 26, 32}); }
TEST(State, GoesOnInFrozenImages) {
  expectSeamless(collectSteps("loop", 45, "freeze:1:0.5"), {20, 21, 22, 25, 29, 32});
}

TEST(State, GoesOnWithWheels) { expectSeamless(collectSteps("loop", 40, "black:0.5:0.3", true), {5, 12, 16, 25}); }

TEST(State, GoesOnWithOtherParameters) {
  const std::vector<Step> some = collectSteps("loop", 45, "black:1:0.4");
  std::vector<Parameters> kinds(3);
  kinds[0].window = 1;
  kinds[1].window = 25;
  kinds[1].features = 20;  // few landmarks and many poses: the path is eliminated first
  kinds[2].disparity_offset = 0.3;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    SCOPED_TRACE("parameters " + std::to_string(i));
    expectSeamless(some, {10, 23, 30}, kinds[i]);
  }
}

// States of earlier versions stay readable: what was a parameter when they began keeps its name and its place.
TEST(State, BeginsWithTheSettingsAsTheyWereOnceCalled) {
  const std::string state = SwfVo(Parameters(), stereoCamera(), kPlace).state();
  std::size_t at = 0;
  for (const char* setting : {"window = 10", "forget = schur", "linearise = first", "features = 100",
                              "pixel_noise_floor = 0.03", "subpixel = true", "disparity_offset = 0.1"}) {
    at = state.find(setting, at);
    ASSERT_NE(at, std::string::npos) << setting;
  }
}

TEST(State, BelongsToThePartsThatAreSwitchedOff) {
  Ablation deletion;
  deletion.delete_departed = true;
  const std::string state = makeAblated(deletion, Parameters(), stereoCamera(), kPlace).state();
  try {
    SwfVo(Parameters(), stereoCamera(), kPlace, state);
    FAIL();
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_EQ(std::string(error.what()),
              "state of swf_vo: was made with forget = delete and is to go on with forget = schur: expected the same "
              "parameters");
  }
}

TEST(State, GoesOnWithPartsSwitchedOff) {
  const std::vector<Step> some = collectSteps("loop", 45, "black:1:0.4");
  std::vector<Ablation> kinds(3);
  kinds[0].latest_jacobians = true;
  kinds[1].delete_departed = true;
  kinds[2].whole_pixels = true;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    SCOPED_TRACE("ablation " + std::to_string(i));
    expectSeamless(some, {10, 23, 30}, Parameters(), kinds[i]);
  }
}

}  // namespace
}  // namespace swf_vo
