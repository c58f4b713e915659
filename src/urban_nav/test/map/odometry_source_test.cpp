// SPDX-License-Identifier: BSD-3-Clause
#include "map/odometry_source.hpp"

#include <gtest/gtest.h>

#include "map/map_options.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

urban_nav_input::SourceInfo makeInfo(bool images, bool sweeps) {
  urban_nav_input::SourceInfo info;
  info.name = "drive";
  info.has_images = images;
  urban_nav_input::InputStream stream;
  stream.role = "points0";
  if (sweeps) stream.lidar.emplace();
  info.inputs.push_back(stream);
  return info;
}

TEST(OdometrySource, AutoTakesWhatThereIs) {
  const MapOptions options;
  EXPECT_EQ(chooseOdometry(options, makeInfo(true, true)), OdometrySource::Both);
  EXPECT_EQ(chooseOdometry(options, makeInfo(true, false)), OdometrySource::Stereo);
  EXPECT_EQ(chooseOdometry(options, makeInfo(false, true)), OdometrySource::Laser);
}

TEST(OdometrySource, AHorizontalLaserIsASourceOfItsOwn) {
  MapOptions options;
  urban_nav_input::SourceInfo info = makeInfo(false, false);
  info.planar_role = "laser0";
  EXPECT_EQ(chooseOdometry(options, info), OdometrySource::Laser);
  options.odometry = OdometryOption::Laser;
  EXPECT_EQ(chooseOdometry(options, info), OdometrySource::Laser);
  info.planar_role.clear();
  try {
    chooseOdometry(options, info);
    FAIL();
  } catch (const urban_nav_core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find("no scans of a horizontal planar laser"), std::string::npos);
  }
}

TEST(OdometrySource, StagesThatAreNamedDecide) {
  MapOptions options;
  options.stages = {"lo"};
  EXPECT_EQ(chooseOdometry(options, makeInfo(true, true)), OdometrySource::Laser);
  options.stages = {"vo"};
  EXPECT_EQ(chooseOdometry(options, makeInfo(true, true)), OdometrySource::Stereo);
  options.stages = {"vo", "lo"};
  EXPECT_EQ(chooseOdometry(options, makeInfo(true, true)), OdometrySource::Both);
}

TEST(OdometrySource, ASourceWithoutItsInputIsNamed) {
  MapOptions options;
  options.odometry = OdometryOption::Laser;
  EXPECT_EQ(chooseOdometry(options, makeInfo(true, true)), OdometrySource::Laser);
  EXPECT_THROW(chooseOdometry(options, makeInfo(true, false)), urban_nav_core::DataError);
  options.odometry = OdometryOption::Stereo;
  EXPECT_THROW(chooseOdometry(options, makeInfo(false, true)), urban_nav_core::DataError);
  options.odometry = OdometryOption::Both;
  EXPECT_EQ(chooseOdometry(options, makeInfo(true, true)), OdometrySource::Both);
  EXPECT_THROW(chooseOdometry(options, makeInfo(false, true)), urban_nav_core::DataError);
  EXPECT_THROW(chooseOdometry(options, makeInfo(true, false)), urban_nav_core::DataError);
}

TEST(OdometrySource, OtherWordsAreRefusedWithThoseAllowed) {
  EXPECT_EQ(parseOdometryOption(""), OdometryOption::Auto);
  EXPECT_EQ(parseOdometryOption("laser"), OdometryOption::Laser);
  try {
    parseOdometryOption("lidar");
    FAIL();
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find("auto, stereo, laser, both"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace urban_nav
