// SPDX-License-Identifier: BSD-3-Clause
#include "image/patch_read.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace urban_nav_core::patch_read {
namespace {

constexpr int kSide = 16, kLine = 12;
using Window = std::array<float, kRows * kLine>;

struct Example {
  std::array<std::uint8_t, kSide * kSide> pixels{};
  std::array<float, kTaps> x{}, y{};
  explicit Example(bool blurs) {
    std::mt19937 random(5);
    for (auto& pixel : pixels) pixel = static_cast<std::uint8_t>(random());
    x = {0.03F, 0.1F, 0.5F, 0.25F, 0.1F, 0.02F};
    y = {0.01F, 0.2F, 0.4F, 0.25F, 0.1F, 0.04F};
    if (!blurs) x[0] = x[5] = y[0] = y[5] = 0.0F;
  }
};

Window filled(double pace) {
  Window made{};
  for (std::size_t i = 0; i < made.size(); ++i)
    made[i] = i % kLine == kLine - 1 ? 0.0F : static_cast<float>(std::sin(pace * static_cast<double>(i)));
  return made;
}

TEST(PatchRead, FiltersAlongBothAxes) {
  for (const bool blurs : {false, true}) {
    const Example e(blurs);
    for (const InstructionSet& set : instructionSets()) {
      Window window;
      set.read(e.pixels.data(), kSide, e.x.data(), e.y.data(), blurs, window.data());
      for (int v = 0; v < kRows; ++v)
        for (int u = 0; u < kRows; ++u) {
          double expected = 0.0;
          for (int j = 0; j < kTaps; ++j)
            for (int i = 0; i < kTaps; ++i)
              expected += static_cast<double>(e.y[static_cast<std::size_t>(j)]) *
                          static_cast<double>(e.x[static_cast<std::size_t>(i)]) *
                          e.pixels[static_cast<std::size_t>((v + j) * kSide + u + i)];
          EXPECT_NEAR(static_cast<double>(window[static_cast<std::size_t>(v * kLine + u)]), expected, 1e-3)
              << set.name << ' ' << u << ' ' << v;
        }
    }
  }
}

TEST(PatchRead, SumsAreThoseOfTheirDefinition) {
  const Window p = filled(0.3), w = filled(0.7), x = filled(1.1), y = filled(1.9), g = filled(2.3);
  std::array<double, 5> expected{};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double value = static_cast<double>(p[i]);
    expected[0] += value * static_cast<double>(x[i]);
    expected[1] += value * static_cast<double>(y[i]);
    expected[2] += value * static_cast<double>(g[i]);
    expected[3] += value * static_cast<double>(w[i]);
    expected[4] += value * value * static_cast<double>(w[i]);
  }
  for (const InstructionSet& set : instructionSets()) {
    const Sums sums = set.measure(p.data(), w.data(), x.data(), y.data(), g.data());
    EXPECT_NEAR(static_cast<double>(sums.along_x), expected[0], 1e-4) << set.name;
    EXPECT_NEAR(static_cast<double>(sums.along_y), expected[1], 1e-4) << set.name;
    EXPECT_NEAR(static_cast<double>(sums.gain), expected[2], 1e-4) << set.name;
    EXPECT_NEAR(static_cast<double>(sums.mean), expected[3], 1e-4) << set.name;
    EXPECT_NEAR(static_cast<double>(sums.square), expected[4], 1e-4) << set.name;
  }
}

TEST(PatchRead, GivesTheSameBitsWithEveryInstructionSet) {
  const auto sets = instructionSets();
  const Window p = filled(0.3), w = filled(0.7), x = filled(1.1), y = filled(1.9), g = filled(2.3);
  const Sums first = sets.front().measure(p.data(), w.data(), x.data(), y.data(), g.data());
  for (const InstructionSet& set : sets) {
    const Sums sums = set.measure(p.data(), w.data(), x.data(), y.data(), g.data());
    EXPECT_EQ(sums.along_x, first.along_x) << set.name;
    EXPECT_EQ(sums.along_y, first.along_y) << set.name;
    EXPECT_EQ(sums.gain, first.gain) << set.name;
    EXPECT_EQ(sums.mean, first.mean) << set.name;
    EXPECT_EQ(sums.square, first.square) << set.name;
    for (const bool blurs : {false, true}) {
      const Example e(blurs);
      Window one, other;
      sets.front().read(e.pixels.data(), kSide, e.x.data(), e.y.data(), blurs, one.data());
      set.read(e.pixels.data(), kSide, e.x.data(), e.y.data(), blurs, other.data());
      for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_TRUE(i % kLine == kLine - 1 || one[i] == other[i]) << set.name << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace urban_nav_core::patch_read
