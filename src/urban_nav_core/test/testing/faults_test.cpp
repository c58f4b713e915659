// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::testing {
namespace {

constexpr StampNs kFirst = 5'000'000'000, kStep = 50'000'000;  // 20 Hz

StereoFrame frame(int i) {
  StereoFrame result;
  result.stamp = kFirst + i * kStep;
  result.left = {32, 24, std::vector<std::uint8_t>(32 * 24)};
  result.right = result.left;
  for (std::size_t k = 0; k < result.left.pixels.size(); ++k) {
    result.left.pixels[k] = static_cast<std::uint8_t>((7 * k + 13 * static_cast<std::size_t>(i)) % 200);
    result.right.pixels[k] = static_cast<std::uint8_t>((5 * k + 3 + 13 * static_cast<std::size_t>(i)) % 200);
  }
  return result;
}

/// Frames 0...39 with one fault from 0.5 s for 0.5 s: frames 10 to 19.
std::vector<std::optional<StereoFrame>> stream(const std::string& fault, std::uint32_t seed = 1) {
  FaultFilter filter({parseFault(fault)}, seed);
  std::vector<std::optional<StereoFrame>> frames;
  for (int i = 0; i < 40; ++i) frames.push_back(filter.apply(frame(i)));
  return frames;
}

bool isUntouched(const std::optional<StereoFrame>& f, int i) {
  return f && f->stamp == frame(i).stamp && f->left.pixels == frame(i).left.pixels &&
         f->right.pixels == frame(i).right.pixels;
}

TEST(Faults, TouchTheirTimeAndNothingElse) {
  for (const char* kind : {"black", "freeze", "swap", "drop", "overexpose", "blur", "corrupt", "noleft", "noright",
                           "jump", "equal", "backward"}) {
    const auto frames = stream(std::string(kind) + ":0.5:0.5");
    for (int i = 0; i < 40; ++i) {
      EXPECT_EQ(isUntouched(frames[static_cast<std::size_t>(i)], i), i < 10 || i >= 20) << kind << ", frame " << i;
    }
  }
}

TEST(Faults, HaveTheirStatedEffects) {
  const std::uint8_t grey = frame(12).left.pixels[3];
  EXPECT_EQ(stream("black:0.5:0.5")[12]->left.pixels, std::vector<std::uint8_t>(32 * 24, 0));
  EXPECT_EQ(stream("black:0.5:0.5")[12]->right.pixels, std::vector<std::uint8_t>(32 * 24, 0));
  EXPECT_EQ(stream("freeze:0.5:0.5")[15]->left.pixels, frame(9).left.pixels);
  EXPECT_EQ(stream("freeze:0.5:0.5")[15]->stamp, frame(15).stamp);
  EXPECT_EQ(stream("swap:0.5:0.5")[12]->left.pixels, frame(12).right.pixels);
  EXPECT_EQ(stream("overexpose:0.5:0.5:2")[12]->left.pixels[3], std::min(255, 2 * grey));
  EXPECT_TRUE(stream("noleft:0.5:0.5")[12]->pair().left.empty());
  EXPECT_FALSE(stream("noleft:0.5:0.5")[12]->pair().right.empty());
  EXPECT_TRUE(stream("noright:0.5:0.5")[12]->pair().right.empty());
  EXPECT_EQ(stream("jump:0.5:0.5:-3")[12]->stamp, frame(12).stamp - 3'000'000'000);
  EXPECT_EQ(stream("equal:0.5:0.5")[12]->stamp, frame(9).stamp);
  EXPECT_EQ(stream("backward:0.5:0.5")[12]->stamp, frame(6).stamp);
}

TEST(Faults, BlurTakesContrastAndCorruptionRows) {
  const auto contrast = [](const GreyImage& image) {
    double sum = 0.0;
    for (std::size_t i = 1; i < image.pixels.size(); ++i) sum += std::abs(image.pixels[i] - image.pixels[i - 1]);
    return sum;
  };
  EXPECT_LT(contrast(stream("blur:0.5:0.5:3")[12]->left), 0.3 * contrast(frame(12).left));
  const GreyImage corrupt = stream("corrupt:0.5:0.5:0.5")[12].value().left, original = frame(12).left;
  int rows = 0;
  for (std::size_t v = 0; v < 24; ++v) {
    bool differs = false;
    for (std::size_t u = 0; u < 32; ++u) differs |= corrupt.pixels[v * 32 + u] != original.pixels[v * 32 + u];
    rows += differs ? 1 : 0;
  }
  EXPECT_GT(rows, 4);
  EXPECT_LT(rows, 20);
}

TEST(Faults, DropsTheShareThatWasAskedBySeed) {
  const auto dropped = [](std::uint32_t seed) {
    FaultFilter filter({parseFault("drop:0:1000:0.3")}, seed);
    std::vector<bool> gone;
    for (int i = 0; i < 2000; ++i) gone.push_back(!filter.apply(frame(i)));
    return gone;
  };
  const std::vector<bool> a = dropped(1);
  EXPECT_NEAR(static_cast<double>(std::count(a.begin(), a.end(), true)), 600.0, 70.0);
  EXPECT_EQ(a, dropped(1));
  EXPECT_NE(a, dropped(2));
}

TEST(Faults, MayComeTogether) {
  FaultFilter filter({parseFault("swap:0:1"), parseFault("noleft:0:1")}, 1);
  const auto both = filter.apply(frame(0));
  ASSERT_TRUE(both);
  EXPECT_TRUE(both->left.pixels.empty());
  EXPECT_EQ(both->right.pixels, frame(0).left.pixels);
}

TEST(Faults, MistakesAreAnsweredWithWhatIsAllowed) {
  for (const char* text : {"", "black", "black:1", "black:1:2:3", "fire:1:2", "drop:0:1:1.5", "drop:0:1:x",
                           "black:-1:2", "black:0:0", "black:0:nan", "drop:0:1:0.1:2"}) {
    EXPECT_THROW(parseFault(text), UserError) << text;
  }
  EXPECT_EQ(toString(parseFault("overexpose:1:2").kind), std::string("overexpose"));
}

}  // namespace
}  // namespace urban_nav_core::testing
