// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/defect.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

TEST(Defects, SensorsHaveTheUsualOnes) {
  const Defects defects;
  EXPECT_TRUE(defects.has(Sensor::Stereo, Defect::Noise));
  EXPECT_TRUE(defects.has(Sensor::Gps, Defect::Gaps));
  EXPECT_FALSE(defects.has(Sensor::Stereo, Defect::Lens));
  EXPECT_FALSE(defects.has(Sensor::Lasers, Defect::Offset));
  EXPECT_TRUE(defects.has(Sensor::Lidar3d, Defect::Edges));
  EXPECT_FALSE(defects.has(Sensor::Lidar3d, Defect::Times));
  for (const Defect defect :
       {Defect::Offset, Defect::Scale, Defect::Delay, Defect::Axes, Defect::Degrees, Defect::Ned, Defect::Gravity})
    EXPECT_FALSE(defects.has(Sensor::Imu, defect));
  EXPECT_FALSE(defects.has(Sensor::Wheels, Defect::Scale));
  for (const Sensor sensor : kAllSensors) {
    EXPECT_TRUE(defects.has(sensor, Defect::Jitter)) << toString(sensor);
    EXPECT_FALSE(defects.has(sensor, Defect::Clock)) << toString(sensor);
  }
}

TEST(Defects, AreSwitchedOneByOne) {
  Defects defects;
  defects.switchOff("imu:noise");
  EXPECT_FALSE(defects.has(Sensor::Imu, Defect::Noise));
  EXPECT_TRUE(defects.has(Sensor::Imu, Defect::Bias));
  EXPECT_TRUE(defects.has(Sensor::Stereo, Defect::Noise));
  defects.switchOn("imu:noise");
  defects.switchOn("stereo:lens");
  EXPECT_TRUE(defects.has(Sensor::Imu, Defect::Noise));
  EXPECT_TRUE(defects.has(Sensor::Stereo, Defect::Lens));
}

TEST(Defects, AllMeansAllSensorsAndTheUsualDefects) {
  Defects defects;
  defects.switchOff("all:all");
  for (const Sensor sensor : kAllSensors) EXPECT_FALSE(defects.has(sensor, Defect::Jitter)) << toString(sensor);
  EXPECT_FALSE(defects.has(Sensor::Lasers, Defect::Edges));
  defects.switchOn("all:clock");
  for (const Sensor sensor : kAllSensors) EXPECT_TRUE(defects.has(sensor, Defect::Clock)) << toString(sensor);
  defects.switchOn("stereo:all");
  EXPECT_TRUE(defects.has(Sensor::Stereo, Defect::Blur));
  EXPECT_FALSE(defects.has(Sensor::Stereo, Defect::Lens));  // a pair of another kind, not one with more errors
}

/// Errors state the wrong value and the allowed ones.
void expectDefectError(const std::string& word, const std::string& found, const std::string& allowed) {
  try {
    Defects().switchOff(word, "--without");
    ADD_FAILURE() << word << " was taken";
  } catch (const urban_nav_core::UserError& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("--without"), std::string::npos) << words;
    EXPECT_NE(words.find(found), std::string::npos) << words;
    EXPECT_NE(words.find(allowed), std::string::npos) << words;
  }
}

TEST(Defects, ListsTheKnownNames) {
  expectDefectError("imu", "imu", "SENSOR:DEFECT");
  expectDefectError("", "\"\"", "SENSOR:DEFECT");
  expectDefectError("sonar:noise", "sonar", "stereo, ladybug, lasers, imu, wheels, gps");
  expectDefectError("imu:blur", "imu:blur",
                    "noise, bias, offset, scale, delay, axes, degrees, ned, gravity, jitter, clock");
  expectDefectError("all:rust", "all:rust", "vignetting");
  for (const Sensor sensor : kAllSensors)
    EXPECT_NE(defectHelp().find(toString(sensor)), std::string::npos) << toString(sensor);
}

}  // namespace
}  // namespace urban_nav_sim
