// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/render.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/textured_room.hpp"

namespace urban_nav_core::testing {
namespace {

RenderCamera camera() { return {311.7, 309.2, 158.3, 117.9, 320, 240, 0.15, 0.5}; }

cv::Mat copy(const std::vector<float>& image, const RenderCamera& camera) {
  return cv::Mat(camera.height, camera.width, CV_32F, const_cast<float*>(image.data())).clone();
}

Pose toRight(const Pose& T_world_left, double baseline) {
  return T_world_left * Pose(Quaterniond::Identity(), Vector3d(baseline, 0.0, 0.0));
}

/// Pixel of a world point, by the definition of a pinhole.
Eigen::Vector2d project(const RenderCamera& camera, const Pose& T_world_camera, const Vector3d& p_world) {
  const Vector3d p = T_world_camera.inverse() * p_world;
  return {camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy};
}

/// A wall at x = `distance` with one bright square of 2 cm, whose middle is at y = z = 0.
Scene wallWithSquare(double distance, const Vector3d& tilt) {
  const auto texture = std::make_shared<Texture>(
      40.0, std::vector<Octave>{}, std::vector<Cells>{{8.0, 8.0, 0.0, 3.99, 3.99, 1.0, 150.0, 150.0, 0}}, 1);
  const Quaterniond turn = expSo3(tilt);
  Rectangle wall;
  wall.a = turn * Vector3d(0.0, -1.0, 0.0);
  wall.b = turn * Vector3d(0.0, 0.0, 1.0);
  wall.size_a = wall.size_b = 8.0;
  wall.corner = Vector3d(distance, 0.0, 0.0) - 4.0 * wall.a - 4.0 * wall.b;
  wall.texture = texture;
  return {{wall}, 0.0};
}

TEST(Render, ASquareIsAtItsProjection) {
  Renderer renderer(camera());
  for (const Vector3d& tilt : {Vector3d(0, 0, 0), Vector3d(0, 0.4, -0.5)}) {
    for (const double shift : {0.0, 0.0013, 0.0029, 0.0041}) {
      const Scene scene = wallWithSquare(2.7, tilt);
      const Pose left = lookingAlong({0.0, 0.05 + shift, -0.03 + 0.7 * shift}, 0.02, 0.01, 0.03);
      for (const Pose& eye : {left, toRight(left, camera().baseline)}) {
        const std::vector<float>& image = renderer.draw(scene, eye);
        double mass = 0.0, u_sum = 0.0, v_sum = 0.0;
        for (int v = 0; v < camera().height; ++v) {
          for (int u = 0; u < camera().width; ++u) {
            const double above = static_cast<double>(image[static_cast<std::size_t>(v * camera().width + u)]) - 40.0;
            mass += above;
            u_sum += u * above;
            v_sum += v * above;
          }
        }
        const Eigen::Vector2d expected = project(camera(), eye, {2.7, 0.0, 0.0});
        EXPECT_NEAR(u_sum / mass, expected.x(), 0.01) << "tilt " << tilt.transpose() << ", shift " << shift;
        EXPECT_NEAR(v_sum / mass, expected.y(), 0.01) << "tilt " << tilt.transpose() << ", shift " << shift;
      }
    }
  }
}

TEST(Render, EachPixelShowsWhatARayMeets) {
  Scene scene = texturedRoom();
  for (std::size_t i = 0; i < scene.rectangles.size(); ++i) {
    scene.rectangles[i].texture =
        std::make_shared<Texture>(3.0 * static_cast<double>(i + 1), std::vector<Octave>{}, std::vector<Cells>{}, 1);
    scene.rectangles[i].shade = 1.0;
  }
  Renderer renderer(camera());
  const Pose eye = lookingAlong({0.5, -0.4, 1.2}, 0.6, 0.1, 0.05);
  const std::vector<float>& image = renderer.draw(scene, eye);
  int flat = 0;
  for (int v = 2; v < camera().height - 2; v += 3) {
    for (int u = 2; u < camera().width - 2; u += 3) {
      const Vector3d ray((u - camera().cx) / camera().fx, (v - camera().cy) / camera().fy, 1.0);
      const auto hit = scene.trace(eye.t(), eye.q() * ray);
      ASSERT_TRUE(hit);
      const auto at = static_cast<std::size_t>(v * camera().width + u);
      const auto row = static_cast<std::size_t>(camera().width);
      const bool border = image[at] != image[at + 1] || image[at] != image[at - 1] || image[at] != image[at + row] ||
                          image[at] != image[at - row];
      if (border) continue;
      EXPECT_FLOAT_EQ(image[at], 3.0F * static_cast<float>(hit->rectangle + 1)) << u << ", " << v;
      ++flat;
    }
  }
  EXPECT_GT(flat, 5000);
}

TEST(Render, IsTheBlurredPictureOfAFinerOne) {
  constexpr int kTimes = 6;
  RenderCamera fine = camera();
  fine.width *= kTimes;
  fine.height *= kTimes;
  fine.fx *= kTimes;
  fine.fy *= kTimes;
  fine.cx = kTimes * (camera().cx + 0.5) - 0.5;
  fine.cy = kTimes * (camera().cy + 0.5) - 0.5;
  const Scene scene = texturedRoom();
  const Pose eye = lookingAlong({-1.5, -0.4, 1.2}, 0.5, 0.1, 0.02);
  Renderer coarse_renderer(camera()), fine_renderer(fine);
  const cv::Mat coarse = copy(coarse_renderer.draw(scene, eye), camera());
  cv::Mat blurred = copy(fine_renderer.draw(scene, eye), fine);
  const double sigma = camera().blur * std::sqrt(kTimes * kTimes - 1.0);
  cv::GaussianBlur(blurred, blurred, cv::Size(), sigma, sigma);
  double sum = 0.0, squares = 0.0;
  int n = 0;
  for (int v = 5; v < camera().height - 5; ++v) {
    for (int u = 5; u < camera().width - 5; ++u) {
      // The middle of a coarse pixel lies between four fine ones.
      const int x = kTimes * u + kTimes / 2 - 1, y = kTimes * v + kTimes / 2 - 1;
      const float expected = 0.25F * (blurred.at<float>(y, x) + blurred.at<float>(y, x + 1) +
                                      blurred.at<float>(y + 1, x) + blurred.at<float>(y + 1, x + 1));
      const double difference = static_cast<double>(coarse.at<float>(v, u) - expected);
      sum += difference;
      squares += difference * difference;
      ++n;
    }
  }
  EXPECT_NEAR(sum / n, 0.0, 0.2);
  EXPECT_LT(std::sqrt(squares / n), 3.0) << "grey levels, of a picture with a contrast of some 30";
}

double cubic(const cv::Mat& image, double u, double v) {
  const int u0 = static_cast<int>(std::floor(u));
  double weights[4];
  const double t = u - u0;
  weights[0] = t * (-0.5 + t * (1.0 - 0.5 * t));
  weights[1] = 1.0 + t * t * (-2.5 + 1.5 * t);
  weights[2] = t * (0.5 + t * (2.0 - 1.5 * t));
  weights[3] = t * t * (-0.5 + 0.5 * t);
  double sum = 0.0;
  for (int k = 0; k < 4; ++k) sum += weights[k] * static_cast<double>(image.at<float>(static_cast<int>(v), u0 - 1 + k));
  return sum;
}

constexpr int kHalf = 5;  // of a patch, px

using Disparities = std::array<double, (2 * kHalf + 1) * (2 * kHalf + 1)>;

/// True disparities of a patch; nothing if it lies on more than one plane.
std::optional<Disparities> disparities(const Scene& scene, const Pose& eye, int u, int v) {
  Disparities result{};
  std::size_t i = 0;
  std::optional<std::size_t> plane;
  for (int y = v - kHalf; y <= v + kHalf; ++y) {
    for (int x = u - kHalf; x <= u + kHalf; ++x) {
      const Vector3d ray((x - camera().cx) / camera().fx, (y - camera().cy) / camera().fy, 1.0);
      const auto hit = scene.trace(eye.t(), eye.q() * ray);
      if (!hit || hit->rectangle != plane.value_or(hit->rectangle)) return std::nullopt;
      plane = hit->rectangle;
      result[i++] = camera().fx * camera().baseline / hit->distance;
    }
  }
  return result;
}

/// Returns the correction of the true disparities of a patch for which the right image fits best; NaN without texture.
double excess(const cv::Mat& left, const cv::Mat& right, int u, int v, const Disparities& truth) {
  double offset = 0.2;
  for (int iteration = 0; iteration < 8; ++iteration) {
    double h = 0.0, g = 0.0;
    std::size_t i = 0;
    for (int y = v - kHalf; y <= v + kHalf; ++y) {
      for (int x = u - kHalf; x <= u + kHalf; ++x) {
        const double at = x - truth[i++] - offset;
        const double slope = 0.5 * (cubic(right, at + 1, y) - cubic(right, at - 1, y));
        const double residual = static_cast<double>(left.at<float>(y, x)) - cubic(right, at, y);
        h += slope * slope;
        g -= slope * residual;
      }
    }
    if (h < 121.0 * 9.0) return std::nan("");
    offset += g / h;
  }
  return offset;
}

TEST(Render, DisparityIsThatOfTheGeometry) {
  const Scene scene = texturedRoom();
  Renderer renderer(camera());
  std::vector<double> errors;
  for (const double yaw : {0.1, 1.7, 3.3}) {
    const Pose eye = lookingAlong({0.3, -0.2, 1.2}, yaw, 0.05, 0.02);
    const cv::Mat left = copy(renderer.draw(scene, eye), camera());
    const cv::Mat right = copy(renderer.draw(scene, toRight(eye, camera().baseline)), camera());
    for (int v = 12; v < camera().height - 12; v += 9) {
      for (int u = 50; u < camera().width - 12; u += 9) {
        const auto truth = disparities(scene, eye, u, v);
        if (!truth) continue;
        const double error = excess(left, right, u, v, *truth);
        if (std::isfinite(error)) errors.push_back(error);
      }
    }
  }
  ASSERT_GT(errors.size(), 500U);
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  EXPECT_NEAR(median(errors), 0.0, 0.004);
  for (double& error : errors) error = std::abs(error);
  EXPECT_LT(median(errors), 0.02);
}

}  // namespace
}  // namespace urban_nav_core::testing
