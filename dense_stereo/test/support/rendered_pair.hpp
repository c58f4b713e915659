// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/testing/render.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace dense_stereo::testing_support {

/// Stereo pair of a camera above the ground z = 0 of a scene, with noise of one grey level.
class RenderedPair {
 public:
  /// The camera is `height` m above (x, y), faces the world's x axis and is pitched down by `pitch` rad and rolled by
  /// `roll` rad.
  RenderedPair(const urban_nav_core::testing::Scene& scene, double x, double y, double height, double pitch,
               double roll)
      : height_(height) {
    using urban_nav_core::Pose;
    Eigen::Matrix3d R_level;  // columns: right, down, forward
    R_level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    const Eigen::Matrix3d R = R_level * Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitX()).toRotationMatrix() *
                              Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    up_ = R.transpose() * Eigen::Vector3d::UnitZ();
    urban_nav_core::testing::RenderCamera rendered;
    rendered.width = 384;
    rendered.height = 288;
    rendered.fx = rendered.fy = 300.0;
    rendered.cx = 191.5;
    rendered.cy = 143.5;
    camera_.left = {rendered.fx, rendered.fy, rendered.cx, rendered.cy, rendered.width, rendered.height};
    camera_.baseline = rendered.baseline;
    urban_nav_core::testing::Renderer renderer(rendered);
    const Eigen::Vector3d p(x, y, height);
    std::mt19937 random(5);
    left_ = noisy(renderer.draw(scene, Pose(R, p)), random);
    right_ = noisy(renderer.draw(scene, Pose(R, p + R.col(0) * rendered.baseline)), random);
  }

  urban_nav_core::StereoPair pair() const {
    const int width = camera_.left.width, rows = camera_.left.height;
    return {0, {left_.data(), width, rows, width}, {right_.data(), width, rows, width}};
  }
  const urban_nav_core::StereoCamera& camera() const { return camera_; }
  const Eigen::Vector3d& up() const { return up_; }  ///< left optical frame
  double height() const { return height_; }

 private:
  static std::vector<std::uint8_t> noisy(const std::vector<float>& levels, std::mt19937& random) {
    std::normal_distribution<float> noise(0.0F, 1.0F);
    std::vector<std::uint8_t> pixels;
    for (const float level : levels)
      pixels.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(level + noise(random)), 0L, 255L)));
    return pixels;
  }

  urban_nav_core::StereoCamera camera_;
  Eigen::Vector3d up_;
  double height_;
  std::vector<std::uint8_t> left_, right_;
};

}  // namespace dense_stereo::testing_support
