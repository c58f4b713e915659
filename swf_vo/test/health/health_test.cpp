// SPDX-License-Identifier: BSD-3-Clause
#include "health/health.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace swf_vo {
namespace {

using urban_nav_core::Health;

Evidence good() {
  Evidence evidence;
  evidence.localised = true;
  evidence.tracked = 90;
  evidence.features = 100;
  evidence.candidates = 95;
  evidence.inlier_share = 0.95;
  return evidence;
}

TEST(HealthMonitor, isOkWithEnoughMatches) {
  HealthMonitor monitor{Parameters()};
  EXPECT_EQ(monitor.judge(good()).health, Health::Ok);
  EXPECT_TRUE(monitor.judge(good()).sentence.empty());
}

TEST(HealthMonitor, isLostWithoutMatchesThenRecoveredForOneFrame) {
  HealthMonitor monitor{Parameters()};
  monitor.judge(good());
  Evidence dark;
  dark.image.usable = false;
  dark.image.reason = Reason::Dark;
  EXPECT_FALSE(monitor.isTrusted(dark));
  for (int i = 0; i < 3; ++i) {
    const auto status = monitor.judge(dark);
    EXPECT_EQ(status.health, Health::Lost);
    EXPECT_EQ(status.reason, static_cast<int>(Reason::Dark));
    EXPECT_FALSE(status.sentence.empty());
  }
  EXPECT_EQ(monitor.judge(good()).health, Health::Recovered);
  EXPECT_EQ(monitor.judge(good()).health, Health::Ok);
}

TEST(HealthMonitor, degradesWithFewMatchesAndSaysWhy) {
  const Parameters parameters;
  HealthMonitor monitor{parameters};
  Evidence few = good();
  few.tracked = parameters.degraded_features - 1;
  few.candidates = few.tracked + 1;
  EXPECT_EQ(monitor.judge(few).health, Health::Degraded);
  EXPECT_EQ(monitor.judge(few).reason, static_cast<int>(Reason::TooFewFeatures));
  few.candidates = 5 * few.tracked;
  EXPECT_EQ(monitor.judge(few).reason, static_cast<int>(Reason::Inconsistent));
  few.tracked = parameters.lost_features - 1;
  EXPECT_EQ(monitor.judge(few).health, Health::Lost);
}

TEST(HealthMonitor, namesRubbishWhereTheRestIsGood) {
  HealthMonitor monitor{Parameters()};
  Evidence evidence = good();
  evidence.corrupted = true;
  evidence.image.reason = Reason::Blurred;
  EXPECT_TRUE(monitor.isTrusted(evidence));
  EXPECT_EQ(monitor.judge(evidence).health, Health::Degraded);
  EXPECT_EQ(monitor.judge(evidence).reason, static_cast<int>(Reason::Corrupted));
  evidence.image.exchange = true;
  evidence.image.reason = Reason::Swapped;
  EXPECT_EQ(monitor.judge(evidence).reason, static_cast<int>(Reason::Swapped));
  evidence.image = {};
  evidence.tracked = 0;
  EXPECT_EQ(monitor.judge(evidence).health, Health::Lost);
  EXPECT_EQ(monitor.judge(evidence).reason, static_cast<int>(Reason::Corrupted));
}

TEST(HealthMonitor, theFirstFrameIsJudgedByItsFeatures) {
  HealthMonitor monitor{Parameters()};
  Evidence first;
  first.first = true;
  first.features = 100;
  EXPECT_EQ(monitor.judge(first).health, Health::Ok);
  HealthMonitor blind{Parameters()};
  first.features = 0;
  EXPECT_EQ(blind.judge(first).health, Health::Lost);
}

TEST(Reasons, haveNamesOfTheirOwnAndSentences) {
  std::set<std::string> names;
  for (int i = 0; i <= static_cast<int>(Reason::Corrupted); ++i) {
    names.insert(toString(static_cast<Reason>(i)));
    if (i > 0) {
      EXPECT_STRNE(sentence(static_cast<Reason>(i)), "");
    }
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(Reason::Corrupted) + 1);
}

}  // namespace
}  // namespace swf_vo
