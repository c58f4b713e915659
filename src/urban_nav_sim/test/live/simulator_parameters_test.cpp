// SPDX-License-Identifier: BSD-3-Clause
#include "live/simulator_parameters.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/parameters/documents.hpp"
#include "urban_nav_core/parameters/print.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

// Tests run in the folder of the package. The build target urban_nav_sim_documents regenerates files that differ.
TEST(SimulatorParameters, ThePackagesDocumentShowsTheTable) {
  const std::string document = urban_nav_core::findParameterDocument(".");
  const std::string text = urban_nav_core::readTextFile(document);
  EXPECT_EQ(text, insertMarkdown(text, document, simulatorTable().stage(), simulatorTable().rows()));
}

TEST(SimulatorParameters, TheirDefaultsAreThoseOfTheCommand) {
  const SessionOptions options = sessionOptions(SimulatorParameters(), ""), standard;
  EXPECT_EQ(options.world, standard.world);
  EXPECT_EQ(options.route, standard.route);
  EXPECT_EQ(options.seed, standard.seed);
  EXPECT_EQ(options.day, standard.day);
  EXPECT_EQ(options.light, standard.light);
  EXPECT_EQ(options.duration, standard.duration);
  EXPECT_EQ(options.sensors, standard.sensors);
  EXPECT_TRUE(options.faults.empty());
}

TEST(SimulatorParameters, ListsAreSeparatedByCommasAndBlanks) {
  SimulatorParameters parameters;
  parameters.sensors = " stereo,imu, gps ";
  parameters.lidar = "livox";
  parameters.fault = "unplug:lasers:20:5 drop:stereo:30:10:0.25";
  const SessionOptions options = sessionOptions(parameters, "");
  EXPECT_EQ(options.sensors, (std::set<Sensor>{Sensor::Stereo, Sensor::Imu, Sensor::Gps}));
  EXPECT_EQ(options.lidar.pattern, LidarModel::Pattern::Rosette);
  ASSERT_EQ(options.faults.size(), 2U);
  EXPECT_EQ(options.faults[0].kind, FaultKind::Unplug);
  EXPECT_EQ(options.faults[1].value, 0.25);
}

TEST(SimulatorParameters, DefectsAreSwitchedAsByTheCommand) {
  SimulatorParameters parameters;
  parameters.without = "all:all";
  parameters.with = "imu:noise, stereo:lens";
  const Defects defects = sessionOptions(parameters, "").defects;
  EXPECT_TRUE(defects.has(Sensor::Imu, Defect::Noise));
  EXPECT_TRUE(defects.has(Sensor::Stereo, Defect::Lens));
  EXPECT_FALSE(defects.has(Sensor::Imu, Defect::Bias));
}

std::string errorMessage(std::string SimulatorParameters::*key, const std::string& text) {
  SimulatorParameters parameters;
  parameters.*key = text;
  try {
    sessionOptions(parameters, "/simulator/");
  } catch (const urban_nav_core::UserError& error) {
    return error.what();
  }
  return "no error";
}

void expectIn(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text << "\n  lacks " << part;
}

TEST(SimulatorParameters, WhatThereIsNotIsNamedWithItsKeyAndWhatThereIs) {
  const std::string world = errorMessage(&SimulatorParameters::world, "atlantis");
  expectIn(world, "/simulator/world");
  expectIn(world, "quad, begbroke, street");
  const std::string route = errorMessage(&SimulatorParameters::route, "moonwalk");
  expectIn(route, "/simulator/route");
  expectIn(route, "orbits4");
  const std::string light = errorMessage(&SimulatorParameters::light, "dawn");
  expectIn(light, "/simulator/light");
  expectIn(light, "day, dusk, night");
  const std::string sensors = errorMessage(&SimulatorParameters::sensors, "stereo, sonar");
  expectIn(sensors, "/simulator/sensors");
  expectIn(sensors, "sonar");
  expectIn(sensors, sensorList());
  expectIn(errorMessage(&SimulatorParameters::sensors, " , "), sensorList());
  expectIn(errorMessage(&SimulatorParameters::with, "imu:blur"), "/simulator/with");
  expectIn(errorMessage(&SimulatorParameters::without, "imu:blur"),
           "noise, bias, offset, scale, delay, axes, degrees, ned, gravity, jitter, clock");
  const std::string fault = errorMessage(&SimulatorParameters::fault, "melt:stereo:0:1");
  expectIn(fault, "/simulator/fault melt:stereo:0:1");
  expectIn(fault, faultList());
}

}  // namespace
}  // namespace urban_nav_sim
