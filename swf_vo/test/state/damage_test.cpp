// SPDX-License-Identifier: BSD-3-Clause
// A state that belongs to something else, or is damaged, is named.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "state/steps.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace swf_vo {
namespace {

std::string catchError(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
                       const std::string& state) {
  try {
    SwfVo(parameters, camera, kPlace, state);
  } catch (const urban_nav_core::Error& error) {
    return error.what();
  }
  return "";
}

std::string someState(std::size_t frames) {
  SwfVo filter(Parameters(), stereoCamera(), kPlace);
  const std::vector<Step> some = collectSteps("loop", 20, "black:1000:1");
  for (std::size_t i = 0; i < frames; ++i) filter.process(some[i].frame.pair());
  return filter.state();
}

TEST(State, BelongsToItsParametersAndItsCamera) {
  const std::string state = someState(3);
  Parameters parameters;
  EXPECT_EQ(catchError(parameters, stereoCamera(), state), "");
  parameters.window = 12;
  EXPECT_EQ(
      catchError(parameters, stereoCamera(), state),
      "state of swf_vo: was made with window = 10 and is to go on with window = 12: expected the same parameters");
  urban_nav_core::StereoCamera camera = stereoCamera();
  camera.baseline += 1e-6;
  EXPECT_EQ(catchError(Parameters(), camera, state),
            "state of swf_vo: was made with another calibration: expected the same camera and extrinsics");
}

TEST(State, IsNamedWhereItIsDamaged) {
  const std::string state = someState(12);
  for (std::size_t i = 0; i < state.size(); i += state.size() / 50) {
    std::string damaged = state;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    EXPECT_NE(catchError(Parameters(), stereoCamera(), damaged), "") << i;
    EXPECT_NE(catchError(Parameters(), stereoCamera(), state.substr(0, i)), "") << i;
  }
}

// Damage under a checksum that is right: what is taken all the same still gives frames.
TEST(State, FuzzedBeyondItsChecksum) {
  const std::string name = "swf_vo";
  const std::vector<Step> some = collectSteps("loop", 20, "black:1000:1");
  const std::string whole = someState(12);
  const urban_nav_core::UnsealedState state = urban_nav_core::unseal(name, 0, 1'000'000, whole);
  const std::string content(state.content);
  int accepted = 0;
  const urban_nav_core::testing::FuzzResult result =
      urban_nav_core::testing::fuzzText({content, content.substr(0, 4096)}, [&](const std::string& damaged) {
        SwfVo filter(Parameters(), stereoCamera(), kPlace, urban_nav_core::seal(name, state.version, damaged));
        if (++accepted > 20) return;
        for (std::size_t i = 12; i < 16; ++i) filter.process(some[i].frame.pair());
        filter.flush();
      });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

}  // namespace
}  // namespace swf_vo
