// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/diagnostics.hpp"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gtest/gtest.h>

#include <thread>

namespace urban_nav_ros {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using urban_nav_core::Health;

TEST(Diagnostics, HealthHasALevel) {
  EXPECT_EQ(toDiagnosticLevel(Health::Ok), DiagnosticStatus::OK);
  EXPECT_EQ(toDiagnosticLevel(Health::Recovered), DiagnosticStatus::OK);
  EXPECT_EQ(toDiagnosticLevel(Health::Degraded), DiagnosticStatus::WARN);
  EXPECT_EQ(toDiagnosticLevel(Health::Lost), DiagnosticStatus::ERROR);
}

TEST(Arrival, ReportsMissingAndSilentInputs) {
  Arrival arrival("/camera/image");
  EXPECT_EQ(arrival.absence(), "/camera/image has not been received yet");
  EXPECT_EQ(arrival.silence(0.0), "") << "absence is reported separately";
  EXPECT_GT(arrival.age(), 1e9);
  arrival.happen();
  EXPECT_TRUE(arrival.any());
  EXPECT_EQ(arrival.absence(), "");
  EXPECT_EQ(arrival.silence(1000.0), "");
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_GE(arrival.age(), 0.02);
  EXPECT_EQ(arrival.silence(0.01).rfind("/camera/image has been silent for 0.", 0), 0U) << arrival.silence(0.01);
}

TEST(Arrival, NothingIsWrongWithATopicWithoutSubscribers) {
  Arrival none;
  EXPECT_EQ(none.absence(), "");
  none.happen();
  EXPECT_EQ(none.silence(-1.0), "");
}

}  // namespace
}  // namespace urban_nav_ros
