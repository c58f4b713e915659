// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/fault.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

TEST(Fault, IsReadAsTheCommandLineHasIt) {
  const Fault fault = parseFault("drop:lasers:12.5:3:0.4");
  EXPECT_EQ(fault.kind, FaultKind::Drop);
  EXPECT_EQ(fault.sensor, Sensor::Lasers);
  EXPECT_EQ(fault.start, 12.5);
  EXPECT_EQ(fault.duration, 3.0);
  EXPECT_EQ(fault.value, 0.4);
  EXPECT_FALSE(parseFault("nan:imu:0:1").value);
  EXPECT_FALSE(fault.isActive(12.4));
  EXPECT_TRUE(fault.isActive(12.5));
  EXPECT_FALSE(fault.isActive(15.5));
}

/// Errors state the wrong value and the allowed ones.
void expectFaultError(const std::string& text, const std::string& found, const std::string& allowed) {
  try {
    parseFault(text);
    ADD_FAILURE() << text << " was taken";
  } catch (const urban_nav_core::UserError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find(found), std::string::npos) << words;
    EXPECT_NE(words.find(allowed), std::string::npos) << words;
  }
}

TEST(Fault, OfTheRigAreReadInTheirForms) {
  EXPECT_EQ(parseFault("knock:stereo:20:0:0.2").kind, FaultKind::Knock);
  EXPECT_TRUE(parseFault("knock:stereo:20:0:0.2").isActive(1e4)) << "to the end";
  EXPECT_TRUE(parseFault("swap:lasers:0:0").isActive(1e4));
  const Fault drift = parseFault("drift:clock:10:20:0.1");
  EXPECT_EQ(drift.sensor, Sensor::Stereo);
  EXPECT_TRUE(drift.isActive(40.0)) << "what has drifted stays so";
  EXPECT_EQ(parseFault("scale:stereo:0:0:1.01").value, 1.01);
  EXPECT_FALSE(parseFault("rain:stereo:5:10").isActive(16.0));
  EXPECT_EQ(parseFault("dark:stereo:5:10").kind, FaultKind::Dark);
}

TEST(Fault, StatesTheAllowedValues) {
  expectFaultError("melt:stereo:0:1", "melt",
                   "drop, freeze, swap, corrupt, jump, unplug, nan, knock, drift, scale, rain, dark");
  expectFaultError("drop:sonar:0:1", "sonar", "stereo, ladybug, lasers, imu, wheels, gps");
  expectFaultError("drop:stereo", "incomplete", "KIND:SENSOR:START_S:DURATION_S");
  expectFaultError("drop:stereo:0:1:0.5:9", "incomplete", "KIND:SENSOR:START_S:DURATION_S");
  expectFaultError("drop:stereo:-1:1", "start", "0...");
  expectFaultError("drop:stereo:0:abc", "duration", "0...");
  expectFaultError("drop:stereo:0:1:1.5", "share", "0...1");
  expectFaultError("freeze:stereo:0:1:1", "freeze takes no value", "KIND");
  expectFaultError("", "fault", "drop");
  expectFaultError("knock:imu:0:0", "knock of \"imu\"", "stereo, lasers, ladybug");
  expectFaultError("rain:lasers:0:0", "rain of \"lasers\"", "stereo");
  expectFaultError("knock:stereo:0:0:90", "turn", "-10...10");
  expectFaultError("scale:stereo:0:0:0", "factor", "0.1...10");
}

}  // namespace
}  // namespace urban_nav_sim
