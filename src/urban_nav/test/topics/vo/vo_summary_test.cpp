// SPDX-License-Identifier: BSD-3-Clause
#include "topics/vo/vo_summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace urban_nav {
namespace {

using urban_nav_core::Health;

VoRun steadyRun() {
  VoRun run;
  run.input = "street.bag";
  for (int i = 0; i < 5; ++i) {
    OdometryFrame row;
    VoFigures figures;
    row.frame = i;
    row.stamp = 50'000'000 * (i + 1);
    figures.statistics.disparity_offset_px = 0.02;
    figures.statistics.disparity_offset_sigma_px = 0.05;
    run.frames.push_back(row);
    run.figures.push_back(figures);
  }
  return run;
}

void lose(OdometryFrame& row, swf_vo::Reason reason, const std::string& sentence) {
  row.status = {Health::Lost, static_cast<int>(reason), sentence};
}

TEST(VoSummary, WarnsOfNothingWhereAllIsWell) { EXPECT_TRUE(summarise(steadyRun()).warnings.empty()); }

TEST(VoSummary, ReportsTheNumberOfLostFramesAndReasons) {
  VoRun run = steadyRun();
  lose(run.frames[1], swf_vo::Reason::NotRectified, "rows differ by 4.0 px");
  lose(run.frames[2], swf_vo::Reason::NotRectified, "rows differ by 5.0 px");
  lose(run.frames[4], swf_vo::Reason::Dark, "no light");
  std::vector<std::string> warnings = summarise(run).warnings;
  std::sort(warnings.begin(), warnings.end());
  const std::vector<std::string> expected = {"street.bag: 1 of 5 frames LOST (dark): no light",
                                             "street.bag: 2 of 5 frames LOST (not_rectified): rows differ by 4.0 px"};
  EXPECT_EQ(warnings, expected);
}

TEST(VoSummary, NamesAnOffsetOutsideItsPrior) {
  VoRun run = steadyRun();
  run.figures.back().statistics.disparity_offset_px = -0.84;
  const std::vector<std::string> warnings = summarise(run).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("calibration: disparities are off by -0.84"), std::string::npos) << warnings[0];
  swf_vo::Parameters wide;
  wide.disparity_offset = 1.0;
  EXPECT_TRUE(summarise(run, wide).warnings.empty());
  run.figures.back().statistics.disparity_offset_sigma_px = 0.0;  // taken as exact
  EXPECT_TRUE(summarise(run).warnings.empty());
}

TEST(VoSummary, NamesRowsThatAreFollowedButApart) {
  VoRun run = steadyRun();
  run.figures.back().statistics.row_offset_px = 0.4;
  EXPECT_TRUE(summarise(run).warnings.empty());
  run.figures.back().statistics.row_offset_px = -2.5;
  const std::vector<std::string> warnings = summarise(run).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("2.5 px higher"), std::string::npos) << warnings[0];
}

TEST(VoSummary, NamesARollAndADelayOutsideTheirPriors) {
  VoRun run = steadyRun();
  run.rig = {0.1 * M_PI / 180.0, 0.02 * M_PI / 180.0, 0.2e-3, 0.05e-3};
  EXPECT_TRUE(summarise(run).warnings.empty());
  run.rig.roll_rad = -0.6 * M_PI / 180.0;
  run.rig.delay_s = -2.8e-3;
  const std::vector<std::string> warnings = summarise(run).warnings;
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings[0].find("rolled by -0.6"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("opens 2.8 +- 0.05 ms before"), std::string::npos) << warnings[1];
  swf_vo::Parameters wide;
  wide.right_roll = 1.0;
  wide.shutter_delay = 5.0;
  EXPECT_TRUE(summarise(run, wide).warnings.empty());
}

}  // namespace
}  // namespace urban_nav
