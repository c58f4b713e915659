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

TEST(HealthMonitor, IsOkWithEnoughMatches) {
  HealthMonitor monitor{Parameters()};
  EXPECT_EQ(monitor.judge(good()).health, Health::Ok);
  EXPECT_TRUE(monitor.judge(good()).sentence.empty());
}

TEST(HealthMonitor, IsLostWithoutMatchesThenRecoveredForOneFrame) {
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

TEST(HealthMonitor, DegradesWithFewMatchesAndStatesTheReason) {
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

TEST(HealthMonitor, NamesRowsAndCalibrationInsteadOfTooFewFeatures) {
  const Parameters parameters;
  HealthMonitor monitor{parameters};
  Evidence few = good();
  few.tracked = few.candidates = 2;
  EXPECT_TRUE(monitor.isUnexplained(few));
  EXPECT_FALSE(monitor.isUnexplained(good()));
  few.rows_disagree_px = 0.6;
  EXPECT_EQ(monitor.judge(few).reason, static_cast<int>(Reason::TooFewFeatures));
  few.rows_disagree_px = 4.0;
  const auto rows = monitor.judge(few);
  EXPECT_EQ(rows.reason, static_cast<int>(Reason::NotRectified));
  EXPECT_NE(rows.sentence.find("by 4.0 px"), std::string::npos) << rows.sentence;
  few.rows_disagree_px.reset();
  few.disparity_offset_px = -0.84;
  few.disparity_offset_sigma_px = 0.05;
  const auto offset = monitor.judge(few);
  EXPECT_EQ(offset.reason, static_cast<int>(Reason::Calibration));
  EXPECT_NE(offset.sentence.find("-0.84"), std::string::npos) << offset.sentence;
  few.disparity_offset_px = 2.0 * parameters.disparity_offset;
  EXPECT_EQ(monitor.judge(few).reason, static_cast<int>(Reason::TooFewFeatures));
  Evidence enough = good();
  enough.disparity_offset_px = -0.84;
  enough.disparity_offset_sigma_px = 0.05;
  EXPECT_NE(monitor.judge(enough).health, Health::Degraded);
}

TEST(HealthMonitor, NamesRubbishWhereTheRestIsGood) {
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

TEST(HealthMonitor, TheFirstFrameIsAssessedByItsFeatures) {
  HealthMonitor monitor{Parameters()};
  Evidence first;
  first.first = true;
  first.features = 100;
  EXPECT_EQ(monitor.judge(first).health, Health::Ok);
  HealthMonitor blind{Parameters()};
  first.features = 0;
  EXPECT_EQ(blind.judge(first).health, Health::Lost);
}

TEST(Reasons, HaveNamesOfTheirOwnAndSentences) {
  std::set<std::string> names;
  for (int i = 0; i <= static_cast<int>(Reason::Calibration); ++i) {
    names.insert(toString(static_cast<Reason>(i)));
    if (i > 0) {
      EXPECT_STRNE(sentence(static_cast<Reason>(i)), "");
    }
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(Reason::Calibration) + 1);
}

}  // namespace
}  // namespace swf_vo
