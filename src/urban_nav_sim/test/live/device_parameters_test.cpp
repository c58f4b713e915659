// SPDX-License-Identifier: BSD-3-Clause
#include "live/device_parameters.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/documents.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

DeviceParameters laserParameters() {
  DeviceParameters parameters;
  parameters.bag = "session.bag";
  parameters.link = "/tmp/laser";
  return parameters;
}

// Tests run in the folder of the package. The build target urban_nav_sim_documents regenerates files that differ.
TEST(DeviceParameters, ThePackagesDocumentShowsTheTable) {
  const std::string document = urban_nav_core::findParameterDocument(".");
  const std::string text = urban_nav_core::readTextFile(document);
  EXPECT_EQ(text, insertMarkdown(text, document, deviceTable().stage(), deviceTable().rows()));
}

TEST(DeviceParameters, TextsAreThoseOfTheCommand) {
  DeviceParameters parameters = laserParameters();
  parameters.fault = "unplug:5:1.5, garbage:1:2:50";
  parameters.clock = "0.5:-30";
  parameters.delay = "uniform:1:20";
  parameters.seed = 7;
  const SimulatedDeviceJob job = simulatedDeviceJob(parameters, "");
  EXPECT_EQ(job.kind, "lms291");
  EXPECT_EQ(job.link, "/tmp/laser");
  ASSERT_EQ(job.options.faults.size(), 2U);
  EXPECT_EQ(job.options.faults[0].kind, DeviceFaultKind::Unplug);
  EXPECT_EQ(job.options.faults[1].value, 50.0);
  EXPECT_DOUBLE_EQ(job.options.clock.offset, 0.5);
  EXPECT_DOUBLE_EQ(job.options.clock.skew, -30e-6);
  ASSERT_TRUE(job.options.delay.has_value());
  EXPECT_EQ(job.options.delay->max_ms, 20.0);
  EXPECT_EQ(job.options.seed, 7U);
}

void expectError(const std::function<void(DeviceParameters&)>& spoil, const std::string& part) {
  DeviceParameters parameters = laserParameters();
  spoil(parameters);
  try {
    simulatedDeviceJob(parameters, "/laser/");
    ADD_FAILURE() << "no error that names " << part;
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(DeviceParameters, WhatIsWrongIsNamedWithItsKey) {
  expectError([](DeviceParameters& p) { p.bag.clear(); }, "/laser/bag");
  expectError([](DeviceParameters& p) { p.link.clear(); }, "/laser/link");
  expectError([](DeviceParameters& p) { p.held = true; }, "/laser/begin");
  expectError([](DeviceParameters& p) { p.tcp = 2947; }, "/laser/tcp");
  expectError([](DeviceParameters& p) { p.fault = "melt:1:2"; }, "/laser/fault melt:1:2");
  expectError([](DeviceParameters& p) { p.clock = "soon"; }, "/laser/clock");
  expectError([](DeviceParameters& p) { p.delay = "uniform:3:1"; }, "/laser/delay");
}

}  // namespace
}  // namespace urban_nav_sim
