// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/sensors/pairing_examination.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace urban_nav_input {
namespace {

using Options = std::vector<std::string>;
using urban_nav_core::StampNs;

constexpr StampNs kMs = 1'000'000, kInterval = 50 * kMs;

/// Right images are `delay` (ns) late; those for which it is negative beyond all measure are absent.
std::vector<Finding> examine(const std::function<StampNs(int)>& delay, const PairingConvention& present = {}) {
  PairingExamination examination;
  std::array<std::int64_t, 2> missing = {{0, 0}};
  for (int i = 0; i < 60; ++i) {
    const StampNs stamp = 1'500'000'000'000'000'000 + i * kInterval;
    examination.add(0, stamp);
    if (delay(i) < -kInterval) {
      ++missing[1];
      continue;
    }
    examination.add(1, stamp + delay(i));
    if (std::abs(delay(i) - present.right_delay) > present.tolerance) ++missing[0], ++missing[1];
  }
  return examination.findings({{"/left", "/right"}}, missing, present);
}

TEST(PairingExamination, FindsNothingWherePairsAreComplete) {
  EXPECT_TRUE(examine([](int i) { return (i % 4) * kMs; }).empty());
}

TEST(PairingExamination, StatesAConstantDelay) {
  for (const StampNs late : {8 * kMs, -12 * kMs, 20 * kMs}) {
    const std::vector<Finding> found = examine([&](int i) { return late + (i % 3) * 100'000; });
    ASSERT_EQ(found.size(), 1U);
    ASSERT_EQ(found[0].options.size(), 2U) << found[0].text;
    EXPECT_EQ(found[0].options[1].substr(0, 18), "input.right_delay=");
    EXPECT_NEAR(std::stod(found[0].options[1].substr(18)), 1e-6 * static_cast<double>(late), 0.3);
  }
  const std::vector<Finding> exact = examine([](int) { return 8 * kMs; });
  EXPECT_NE(exact[0].text.find("8 ms later"), std::string::npos) << exact[0].text;
  EXPECT_EQ(exact[0].options, (Options{"--set", "input.right_delay=8"}));
}

TEST(PairingExamination, CountsFromThePresentDelay) {
  const PairingConvention present{30 * kMs, 5 * kMs};
  const std::vector<Finding> found = examine([](int) { return 40 * kMs; }, present);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].options, (Options{"--set", "input.right_delay=40"}));
  const std::vector<Finding> lost = examine([](int i) { return i == 7 ? -1000 * kMs : 30 * kMs; }, present);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_TRUE(lost[0].options.empty()) << lost[0].text;
}

TEST(PairingExamination, WidensThePairingOfStampsThatVary) {
  const auto jitter = [](int i) {
    return std::array<StampNs, 4>{{3, 16, 0, 11}}[static_cast<std::size_t>(i % 4)] * kMs;
  };
  const std::vector<Finding> found = examine(jitter);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].text.find("16 ms"), std::string::npos) << found[0].text;
  EXPECT_EQ(found[0].options, (Options{"--set", "input.pairing_tolerance=21"}));
  const std::vector<Finding> far = examine([&](int i) { return 12 * kMs + jitter(i) / 2; });
  ASSERT_EQ(far.size(), 1U);
  ASSERT_EQ(far[0].options.size(), 4U) << far[0].text;
  EXPECT_EQ(far[0].options[1].substr(0, 18), "input.right_delay=");
  EXPECT_EQ(far[0].options[3].substr(0, 24), "input.pairing_tolerance=");
}

TEST(PairingExamination, OffersNothingForCamerasThatRunFreely) {
  const std::vector<Finding> found = examine([](int i) { return (i % 50 - 25) * kMs; });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].text.find("not synchronised"), std::string::npos) << found[0].text;
  EXPECT_TRUE(found[0].options.empty());
}

TEST(PairingExamination, NamesTheCameraThatLosesImages) {
  const std::vector<Finding> found = examine([](int i) { return i % 5 == 2 ? -1000 * kMs : 0; });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].text.find("/right: 12 images are missing"), std::string::npos) << found[0].text;
  EXPECT_TRUE(found[0].options.empty());
}

}  // namespace
}  // namespace urban_nav_input
