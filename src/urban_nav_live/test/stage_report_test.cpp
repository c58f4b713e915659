// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/stage_report.hpp"

#include <gtest/gtest.h>

namespace urban_nav_live {
namespace {

using urban_nav_core::Health;
using Summary = std::pair<ReportLevel, std::string>;

TEST(StageReport, LevelFollowsTheHealth) {
  EXPECT_EQ(reportLevel(Health::Ok), ReportLevel::Ok);
  EXPECT_EQ(reportLevel(Health::Recovered), ReportLevel::Ok);
  EXPECT_EQ(reportLevel(Health::Degraded), ReportLevel::Warning);
  EXPECT_EQ(reportLevel(Health::Lost), ReportLevel::Error);
}

TEST(StageReport, SummaryIsTheSentenceOrTheHealth) {
  StageReport report;
  EXPECT_EQ(summarise(report, false, ""), Summary(ReportLevel::Ok, "OK"));
  report.status = {Health::Degraded, 3, "11 features"};
  EXPECT_EQ(summarise(report, false, ""), Summary(ReportLevel::Warning, "11 features"));
  report.summary = "no session";
  EXPECT_EQ(summarise(report, false, ""), Summary(ReportLevel::Warning, "no session"));
}

TEST(StageReport, ATopicFaultIsAWarningAtLeast) {
  StageReport report;
  EXPECT_EQ(summarise(report, false, "/a is silent"), Summary(ReportLevel::Warning, "OK: /a is silent"));
  report.status.health = Health::Lost;
  EXPECT_EQ(summarise(report, false, "/a is silent").first, ReportLevel::Error);
}

TEST(StageReport, FlagsRaiseTheLevel) {
  StageReport report;
  report.is_warning = true;
  EXPECT_EQ(summarise(report, false, "").first, ReportLevel::Warning);
  report.is_error = true;
  EXPECT_EQ(summarise(report, false, "").first, ReportLevel::Error);
}

TEST(StageReport, InAPauseNothingIsWrong) {
  StageReport report;
  report.is_error = true;
  EXPECT_EQ(summarise(report, true, "/a is silent"), Summary(ReportLevel::Ok, "paused"));
}

TEST(StageReport, FiguresKeepTheirOrderAndReadAsNumbers) {
  StageReport report;
  report.add("frames", 12);
  report.add("error (px)", 0.25);
  report.add("store", "/a");
  ASSERT_EQ(report.figures.size(), 3U);
  EXPECT_EQ(report.figures[0].name + report.figures[0].value, "frames12");
  EXPECT_EQ(report.figures[1].value, "0.25");
  EXPECT_EQ(report.figures[2].value, "/a");
}

}  // namespace
}  // namespace urban_nav_live
