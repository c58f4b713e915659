// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/session/calibration_fingerprint.hpp"

#include <gtest/gtest.h>

namespace urban_nav_registration {
namespace {

TEST(CameraWords, ChangesWithWhateverChangesViews) {
  urban_nav_core::StereoCamera camera;
  camera.left = {400.0, 400.0, 255.5, 191.5, 512, 384};
  camera.baseline = 0.12;
  const urban_nav_core::Pose place(urban_nav_core::Quaterniond::Identity(), Eigen::Vector3d(0.1, 0.0, 1.0));
  const std::string words = calibrationFingerprint(camera, place);
  EXPECT_EQ(words, calibrationFingerprint(camera, place));
  urban_nav_core::StereoCamera other = camera;
  other.baseline = 0.1200001;
  EXPECT_NE(words, calibrationFingerprint(other, place));
  other = camera;
  other.left.height = 383;
  EXPECT_NE(words, calibrationFingerprint(other, place));
  EXPECT_NE(words, calibrationFingerprint(camera, urban_nav_core::Pose()));
  EXPECT_FALSE(isSameCalibration(words, calibrationFingerprint(other, place)));
  EXPECT_FALSE(isSameCalibration(words, calibrationFingerprint(camera, urban_nav_core::Pose())));
  EXPECT_FALSE(isSameCalibration(words, ""));
  EXPECT_FALSE(isSameCalibration(words, words + " 1"));
}

TEST(CameraWords, RoundingIsNoOtherCamera) {
  urban_nav_core::StereoCamera camera;
  camera.left = {400.0, 400.0, 255.5, 191.5, 512, 384};
  camera.baseline = 0.12;
  const urban_nav_core::Pose place(urban_nav_core::Quaterniond::Identity(), Eigen::Vector3d(0.1, 0.0, 1.0));
  const std::string words = calibrationFingerprint(camera, place);
  EXPECT_TRUE(isSameCalibration(words, words));
  urban_nav_core::StereoCamera rounded = camera;
  rounded.left.fx += 1e-9;
  EXPECT_TRUE(isSameCalibration(words, calibrationFingerprint(rounded, place)));
  rounded.left.fx += 1e-4;
  EXPECT_FALSE(isSameCalibration(words, calibrationFingerprint(rounded, place)));
}

}  // namespace
}  // namespace urban_nav_registration
