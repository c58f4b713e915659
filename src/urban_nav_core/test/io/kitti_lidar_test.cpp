// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/kitti_lidar.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr const char* kCalibration = "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: 0 -1 0 0.1 0 0 -1 -0.2 1 0 0 -0.3\n";
constexpr const char* kVelodyne =
    "calib_time: 15-Mar-2012 11:37:16\nR: 0 -1 0 0 0 -1 1 0 0\nT: 0.1 -0.2 -0.3\ndelta_f: 0 0\n";

std::string catchMessage(const std::string& text) {
  try {
    parseKittiTr(text, "calib.txt");
    parseKittiVeloToCam(text, "calib.txt");
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(KittiLidar, BothFilesGiveThePlace) {
  for (const Pose& pose : {*parseKittiTr(kCalibration, "calib.txt"), parseKittiVeloToCam(kVelodyne, "velo.txt")}) {
    EXPECT_NEAR((pose * Vector3d(10.0, 2.0, 1.0) - Vector3d(-1.9, -1.2, 9.7)).norm(), 0.0, 1e-12);
  }
  EXPECT_FALSE(parseKittiTr("P0: 1 2 3\n", "calib.txt"));
}

TEST(KittiLidar, TheRectificationIsFoundAmongOtherRows) {
  const auto R = parseKittiRectification("S_00: 1 2\nR_rect_00: 1 0 0 0 1 0 0 0 1\n", "calib_cam_to_cam.txt");
  ASSERT_TRUE(R);
  EXPECT_EQ(*R, Matrix3d::Identity());
  EXPECT_FALSE(parseKittiRectification("S_00: 1 2\n", "calib_cam_to_cam.txt"));
}

TEST(KittiLidar, BadRowsAreNamedWithTheirLine) {
  EXPECT_NE(catchMessage("P0: 1\nTr: 1 2 3\n").find("calib.txt:2"), std::string::npos);
  EXPECT_NE(catchMessage("Tr: 1 0 0 0 0 1 0 0 0 0 nan 0\n").find("nan"), std::string::npos);
  EXPECT_NE(catchMessage("Tr: 2 0 0 0 0 1 0 0 0 0 1 0\n").find("not a rotation"), std::string::npos);
  EXPECT_NE(catchMessage("R: 1 0 0 0 1 0 0 0 1\n").find("no line T"), std::string::npos);
}

TEST(KittiLidar, DamagedFiles) {
  const auto read = [](const std::string& text) {
    parseKittiTr(text, "a");
    parseKittiRectification(text, "a");
    parseKittiVeloToCam(text, "a");
  };
  EXPECT_EQ(testing::fuzzText({kCalibration, kVelodyne}, read).failure.substr(0, 300), "");
}

}  // namespace
}  // namespace urban_nav_core
