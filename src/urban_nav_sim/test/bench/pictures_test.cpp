// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "../../bench/support/free_camera.hpp"
#include "../../bench/support/panorama.hpp"
#include "../../bench/support/point_view.hpp"

namespace urban_nav_sim::bench {
namespace {

using Eigen::Vector3d;

TEST(FreeCamera, HasItsAimInTheMiddleAndItsFieldFromEdgeToEdge) {
  const FreeCamera camera{{10, -4, 30}, {2, 7, 0}, 1.2, 320, 200};
  const Lens lens = camera.lens();
  const auto T_camera_world = camera.place().inverse();
  const Eigen::Vector2d middle(159.5, 99.5);
  EXPECT_LT((*lens.project(T_camera_world * camera.to) - middle).norm(), 1e-9);
  EXPECT_NEAR(std::atan(lens.idealAt({-0.5, 99.5})->x()), -0.6, 1e-9);
  // Level, and upright: what is over the aim is over it in the picture.
  const Eigen::Vector2d over = *lens.project(T_camera_world * (camera.to + Vector3d(0, 0, 1)));
  EXPECT_NEAR(over.x(), middle.x(), 1e-9);
  EXPECT_LT(over.y(), middle.y());
  EXPECT_EQ(camera.lens(3).width, 960);
}

TEST(Panorama, ShowsAheadInTheMiddleAndGoesClockwise) {
  const auto cameras = ladybug();
  std::array<cv::Mat, 5> images;
  for (std::size_t i = 0; i < images.size(); ++i)
    images[i] = cv::Mat(512, 384, CV_8UC3, cv::Scalar::all(40.0 * static_cast<double>(i) + 20.0));
  const cv::Mat round = panorama(cameras, images, 500);
  ASSERT_EQ(round.size(), cv::Size(500, 127));
  const auto at = [&](int u, int v) { return static_cast<int>(round.at<cv::Vec3b>(v, u)[1]); };
  for (int i = 0; i < 5; ++i) EXPECT_EQ(at((250 + 100 * i) % 500, 64), 40 * i + 20) << i;
  for (int u = 0; u < 500; ++u) {  // nowhere a hole
    EXPECT_GE(at(u, 0), 19);
    EXPECT_GE(at(u, 126), 19);
  }
  EXPECT_GT(at(300, 64), 25);  // at a seam, between both
  EXPECT_LT(at(300, 64), 55);
}

TEST(DrawCloud, WhatIsNearerHidesWhatIsFarther) {
  const FreeCamera camera{{0, 0, 0}, {1, 0, 0}, 1.0, 64, 64};
  const Return low{{20.0F, 0.0F, 0.0F}, 255.0F}, before{{2.0F, 0.0F, 0.0F}, 0.0F};
  const auto middle = [&](const std::vector<Return>& cloud) {
    return drawCloud(cloud, camera, 10.0F).at<cv::Vec3b>(32, 32);
  };
  const cv::Vec3b background = middle({}), far = middle({low}), near = middle({low, before});
  EXPECT_NE(far, background);
  EXPECT_EQ(near, middle({before, low}));
  EXPECT_LT(near[0] + near[1] + near[2], far[0] + far[1] + far[2]);
  EXPECT_EQ(middle({{{-2.0F, 0.0F, 0.0F}, 255.0F}}), background);  // at negative depth
}

}  // namespace
}  // namespace urban_nav_sim::bench
