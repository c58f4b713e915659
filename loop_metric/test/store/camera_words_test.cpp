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
}

}  // namespace
}  // namespace loop_metric
