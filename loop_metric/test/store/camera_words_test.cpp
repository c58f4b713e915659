// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/camera_words.hpp"

#include <gtest/gtest.h>

namespace loop_metric {
namespace {

TEST(CameraWords, tellsWhateverMakesViewsDiffer) {
  urban_nav_core::StereoCamera camera;
  camera.left = {400.0, 400.0, 255.5, 191.5, 512, 384};
  camera.baseline = 0.12;
  const urban_nav_core::Pose place(urban_nav_core::Quaterniond::Identity(), Eigen::Vector3d(0.1, 0.0, 1.0));
  const std::string words = cameraWords(camera, place);
  EXPECT_EQ(words, cameraWords(camera, place));
  urban_nav_core::StereoCamera other = camera;
  other.baseline = 0.1200001;
  EXPECT_NE(words, cameraWords(other, place));
  other = camera;
  other.left.height = 383;
  EXPECT_NE(words, cameraWords(other, place));
  EXPECT_NE(words, cameraWords(camera, urban_nav_core::Pose()));
  EXPECT_FALSE(areOfOneCamera(words, cameraWords(other, place)));
  EXPECT_FALSE(areOfOneCamera(words, cameraWords(camera, urban_nav_core::Pose())));
  EXPECT_FALSE(areOfOneCamera(words, ""));
  EXPECT_FALSE(areOfOneCamera(words, words + " 1"));
}

TEST(CameraWords, roundingIsNoOtherCamera) {
  urban_nav_core::StereoCamera camera;
  camera.left = {400.0, 400.0, 255.5, 191.5, 512, 384};
  camera.baseline = 0.12;
  const urban_nav_core::Pose place(urban_nav_core::Quaterniond::Identity(), Eigen::Vector3d(0.1, 0.0, 1.0));
  const std::string words = cameraWords(camera, place);
  EXPECT_TRUE(areOfOneCamera(words, words));
  urban_nav_core::StereoCamera rounded = camera;
  rounded.left.fx += 1e-9;
  EXPECT_TRUE(areOfOneCamera(words, cameraWords(rounded, place)));
  rounded.left.fx += 1e-4;
  EXPECT_FALSE(areOfOneCamera(words, cameraWords(rounded, place)));
}

}  // namespace
}  // namespace loop_metric
