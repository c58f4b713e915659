// SPDX-License-Identifier: BSD-3-Clause
#include "camera/motion_blur.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {
namespace {

constexpr float kSharp = 0.3F;     // px: shorter blur is negligible against the point spread
constexpr float kLongest = 24.0F;  // px

/// Adds weight * value to `sum`, bilinear and clamped at the border.
void addSample(const Picture& picture, float u, float v, float weight, std::array<float, 3>& sum) {
  u = std::clamp(u, 0.0F, static_cast<float>(picture.width - 1) - 1e-3F);
  v = std::clamp(v, 0.0F, static_cast<float>(picture.height - 1) - 1e-3F);
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  const float a = u - static_cast<float>(u0), b = v - static_cast<float>(v0);
  const auto channels = static_cast<std::size_t>(picture.channels);
  const float* upper = &picture.radiance[picture.at(u0, v0) * channels];
  const float* lower = upper + static_cast<std::size_t>(picture.width) * channels;
  for (std::size_t i = 0; i < channels; ++i) {
    const float top = upper[i] + a * (upper[i + channels] - upper[i]);
    const float bottom = lower[i] + a * (lower[i + channels] - lower[i]);
    sum[i] += weight * (top + b * (bottom - top));
  }
}

}  // namespace

CameraMotion computeCameraMotion(const MotionState& motion_state, const urban_nav_core::Pose& T_base_camera) {
  const Eigen::Vector3d velocity_base = motion_state.T_world_base.q().conjugate() * motion_state.velocity_world;
  const Eigen::Quaterniond R_camera_base = T_base_camera.q().conjugate();
  return {R_camera_base * (velocity_base + motion_state.rate_base.cross(T_base_camera.t())),
          R_camera_base * motion_state.rate_base};
}

Eigen::Vector2f flowAt(const RayTable& rays, int u, int v, float depth, const CameraMotion& motion) {
  const Eigen::Vector2f& at = rays.at(u, v);
  const Eigen::Vector3f velocity = motion.velocity.cast<float>(), rate = motion.rate.cast<float>();
  const float x = at.x(), y = at.y(), near = 1.0F / depth;
  // Longuet-Higgins and Prazdny 1980, for a moving camera in a static world.
  const float turn = rate.x() * y - rate.y() * x;
  const Eigen::Vector2f ideal(-(velocity.x() - x * velocity.z()) * near - (rate.y() - rate.z() * y) + x * turn,
                              -(velocity.y() - y * velocity.z()) * near - (rate.z() * x - rate.x()) + y * turn);
  const Eigen::Vector2f right = rays.right(u, v), down = rays.down(u, v);
  const float area = right.x() * down.y() - right.y() * down.x();
  return {(ideal.x() * down.y() - ideal.y() * down.x()) / area, (right.x() * ideal.y() - right.y() * ideal.x()) / area};
}

void blurByMotion(const Picture& picture, const RayTable& rays, const CameraMotion& motion, double seconds,
                  std::vector<float>& radiance) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  radiance.resize(picture.radiance.size());
  urban_nav_core::forEach(static_cast<std::size_t>(picture.height), 8, [&](std::size_t row) {
    const int v = static_cast<int>(row);
    for (int u = 0; u < picture.width; ++u) {
      const std::size_t pixel = picture.at(u, v);
      Eigen::Vector2f smear = flowAt(rays, u, v, picture.depth[pixel], motion) * static_cast<float>(seconds);
      const float length = smear.norm();
      float* out = &radiance[pixel * channels];
      if (!(length > kSharp)) {
        std::copy_n(&picture.radiance[pixel * channels], channels, out);
        continue;
      }
      if (length > kLongest) smear *= kLongest / length;
      const int taps = 1 + static_cast<int>(std::ceil(std::min(length, kLongest)));
      std::array<float, 3> sum{};
      for (int i = 0; i < taps; ++i) {
        const float along = (static_cast<float>(i) + 0.5F) / static_cast<float>(taps) - 0.5F;
        addSample(picture, static_cast<float>(u) + along * smear.x(), static_cast<float>(v) + along * smear.y(),
                  1.0F / static_cast<float>(taps), sum);
      }
      std::copy_n(sum.data(), channels, out);
    }
  });
}

}  // namespace urban_nav_sim
