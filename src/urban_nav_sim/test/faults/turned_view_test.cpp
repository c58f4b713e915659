// SPDX-License-Identifier: BSD-3-Clause
#include "faults/turned_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace urban_nav_sim {
namespace {

/// Brightness that depends on the direction alone: a smooth function of its tangent along x.
cv::Mat view(const Lens& lens, double yaw) {
  cv::Mat image(lens.height, lens.width, CV_8UC1);
  for (int v = 0; v < lens.height; ++v)
    for (int u = 0; u < lens.width; ++u) {
      const Eigen::Vector2d ideal = lens.idealAt(Eigen::Vector2d(u, v)).value_or(Eigen::Vector2d::Zero());
      const double angle = std::atan(ideal.x()) + yaw;
      image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(std::lround(128.0 + 100.0 * std::sin(9.0 * angle)));
    }
  return image;
}

TEST(TurnedView, IsTheImageOfTheTurnedCamera) {
  Lens lens{160, 120, 140.0, 140.0, 80.0, 60.0, {-0.2, 0.05, 0.0, 0.0, 0.0}};
  const double yaw = 0.02;
  const cv::Mat turned = TurnedView(lens, Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY())).apply(view(lens, 0.0));
  const cv::Mat expected = view(lens, yaw);
  for (int u = 10; u < 150; ++u)  // along the middle row, where a turn about y changes the angle alone
    EXPECT_NEAR(turned.at<std::uint8_t>(60, u), expected.at<std::uint8_t>(60, u), 2) << u;
}

TEST(TurnedView, WithoutATurnKeepsEachPixel) {
  const Lens lens{32, 24, 30.0, 30.0, 16.0, 12.0, {}};
  const cv::Mat image = view(lens, 0.3);
  EXPECT_EQ(cv::norm(TurnedView(lens, Eigen::AngleAxisd::Identity()).apply(image), image, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace urban_nav_sim
