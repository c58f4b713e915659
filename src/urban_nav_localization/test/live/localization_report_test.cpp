// SPDX-License-Identifier: BSD-3-Clause
#include "live/localization_report.hpp"

#include <gtest/gtest.h>

namespace urban_nav_localization {
namespace {

TEST(LocalizationReport, TheMostSevereFaultComesFirst) {
  StageState state;
  state.image_fault = "/stereo/left/image_raw has not been received yet";
  EXPECT_EQ(makeReport(state).reason_name, "NoImages");
  state.camera_fault = "other sizes";
  EXPECT_EQ(makeReport(state).reason_name, "NoCamera");
  state.odometry_fault = "/vo/odometry has not been received yet";
  EXPECT_EQ(makeReport(state).reason_name, "NoOdometry");
  EXPECT_FALSE(makeReport(state).is_error);
  state.localiser.map_fault = "another camera";
  EXPECT_EQ(makeReport(state).reason_name, "NoMap");
  EXPECT_TRUE(makeReport(state).is_error);
  EXPECT_EQ(makeReport(state).status.sentence, "another camera");
}

TEST(LocalizationReport, APauseIsNoFault) {
  StageState state;
  state.paused = true;
  state.odometry_fault = "silent";
  EXPECT_EQ(makeReport(state).reason_name, "None");
}

TEST(LocalizationReport, AStateOtherThanLocalizedIsAWarningAndNoFault) {
  StageState state;
  const urban_nav_live::StageReport lost = makeReport(state);
  EXPECT_EQ(lost.reason_name, "None");
  EXPECT_TRUE(lost.is_warning);
  state.localiser.estimate.state = LocalizationState::Localized;
  EXPECT_FALSE(makeReport(state).is_warning);
  EXPECT_EQ(makeReport(state).summary.substr(0, 9), "LOCALIZED");
}

TEST(LocalizationReport, ReadingTheMapIsNamedWithItsProgress) {
  StageState state;
  state.localiser.map_keyframes = 7;
  state.localiser.map_keyframes_read = 3;
  EXPECT_EQ(makeReport(state).reason_name, "ReadingMap");
  EXPECT_NE(makeReport(state).status.sentence.find("3 of 7"), std::string::npos);
}

TEST(LocalizationReport, FaultsHaveNames) {
  for (int i = 0; i <= 5; ++i) EXPECT_STRNE(toString(static_cast<StageFault>(i)), "");
}

}  // namespace
}  // namespace urban_nav_localization
