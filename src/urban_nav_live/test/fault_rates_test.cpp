// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/fault_rates.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "urban_nav_live/beam_faults.hpp"

namespace urban_nav_live {
namespace {

/// Rates with a simulated clock, and counters of dropped pairs.
struct Rates {
  std::pair<ReportLevel, std::string> second(std::int64_t faults, std::int64_t total) {
    faults_ += faults;
    total_ += total;
    now_ += std::chrono::seconds(1);
    rates_.add({{"pairs were dropped", faults_, total_, "lower the rate of the camera"}});
    return rates_.summary();
  }
  FaultRates::Clock::time_point now_{};
  std::int64_t faults_ = 0, total_ = 0;
  FaultRates rates_{[this] { return now_; }};
};

TEST(FaultRates, NameTheShareAndWhatToDo) {
  Rates rates;
  EXPECT_EQ(rates.second(0, 20).first, ReportLevel::Ok);
  for (int i = 0; i < 20; ++i) rates.second(0, 20);
  const auto [level, text] = rates.second(20, 20);
  EXPECT_EQ(level, ReportLevel::Warning);
  EXPECT_EQ(text, "10 % of the pairs were dropped in the last 10 s: lower the rate of the camera");
  rates.second(20, 20);
  EXPECT_EQ(rates.second(20, 20).first, ReportLevel::Error) << "30 %";
  for (int i = 0; i < 7; ++i) EXPECT_EQ(rates.second(0, 20).first, ReportLevel::Error) << i;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(rates.second(0, 20).first, ReportLevel::Warning) << i;
  EXPECT_EQ(rates.second(0, 20).first, ReportLevel::Ok) << "dropped after ten seconds";
}

TEST(FaultRates, OneInAHundredIsNoFault) {
  Rates rates;
  for (int i = 0; i < 30; ++i) EXPECT_EQ(rates.second(1, 100).first, ReportLevel::Ok) << i;
  EXPECT_EQ(rates.second(2, 100).second,
            "1.1 % of the pairs were dropped in the last 10 s: lower the rate of the camera");
}

TEST(FaultRates, AStageThatBeginsAgainCountsAgain) {
  Rates rates;
  rates.second(100, 100);
  rates.faults_ = rates.total_ = 0;
  EXPECT_EQ(rates.second(0, 20).first, ReportLevel::Ok);
}

TEST(BeamFaults, CountRangesThatAreNotNumbers) {
  urban_nav_core::PlanarScan scan;
  scan.ranges = {1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 0.0F};
  BeamFaults faults;
  faults.add(scan);
  StageReport report;
  faults.addTo(report);
  ASSERT_EQ(report.fault_counts.size(), 1U);
  EXPECT_EQ(report.fault_counts[0].faults, 1);
  EXPECT_EQ(report.fault_counts[0].total, 4);
}

TEST(FaultRates, AllAreNamed) {
  FaultRates rates;
  rates.add({{"pairs were late", 1, 1, "x"}, {"scans were late", 1, 10, "y"}, {"c", 0, 10, "z"}});
  EXPECT_EQ(rates.summary().first, ReportLevel::Error);
  EXPECT_EQ(rates.summary().second,
            "100 % of the pairs were late in the last 10 s: x; 10 % of the scans were late in the last 10 s: y");
}

}  // namespace
}  // namespace urban_nav_live
