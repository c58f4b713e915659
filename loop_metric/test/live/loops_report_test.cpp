// SPDX-License-Identifier: BSD-3-Clause
#include "live/loops_report.hpp"

#include <gtest/gtest.h>

namespace loop_metric {
namespace {

TEST(LoopsReport, TheMostSevereFaultComesFirst) {
  LoopsState state;
  EXPECT_EQ(makeReport(state).reason_name, "None");
  state.laser_pose_fault = "no static tf";
  EXPECT_EQ(makeReport(state).reason_name, "NoLaserPlace");
  state.laser_fault = "/laser_left/scan has not been received yet";
  EXPECT_EQ(makeReport(state).reason_name, "NoLasers");
  state.image_fault = "/stereo/left/image_raw has been silent for 6.0 s";
  EXPECT_EQ(makeReport(state).reason_name, "NoImages");
  state.camera_fault = "other sizes";
  EXPECT_EQ(makeReport(state).reason_name, "NoCamera");
  state.odometry_fault = "/vo/odometry has not been received yet";
  EXPECT_EQ(makeReport(state).reason_name, "NoOdometry");
  EXPECT_FALSE(makeReport(state).is_error);
  state.store.fault = "disk full";
  EXPECT_EQ(makeReport(state).reason_name, "NotStored");
  EXPECT_TRUE(makeReport(state).is_error);
}

TEST(LoopsReport, UnusedSensorsAreNoFault) {
  LoopsState state;
  state.stereo = state.clouds = false;
  state.image_fault = state.camera_fault = state.laser_fault = state.laser_pose_fault = "missing";
  EXPECT_EQ(makeReport(state).reason_name, "None");
}

TEST(LoopsReport, APauseIsNoFault) {
  LoopsState state;
  state.paused = true;
  state.store.fault = "disk full";
  EXPECT_EQ(makeReport(state).reason_name, "None");
}

}  // namespace
}  // namespace loop_metric
