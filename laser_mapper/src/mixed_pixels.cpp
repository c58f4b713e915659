// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/mixed_pixels.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace laser_mapper {

using urban_nav_core::Beam;
using urban_nav_core::Scan;

namespace {

constexpr float kGate = 4.0F;           // standard deviations
constexpr float kMaxBeamAngle = 0.03F;  // rad: beams further apart are not neighbours

/// Returns the sines of the angles between adjacent beams; 0 where a beam between them is missing.
std::vector<float> neighbourSines(const Scan& scan) {
  std::vector<float> sines(scan.beams.size(), 0.0F);
  for (std::size_t i = 0; i + 1 < scan.beams.size(); ++i) {
    const float sine = scan.beams[i].direction.cross(scan.beams[i + 1].direction).norm();
    if (sine < kMaxBeamAngle) sines[i] = sine;
  }
  std::vector<float> known;
  for (const float sine : sines)
    if (sine > 0.0F) known.push_back(sine);
  if (known.empty()) return sines;
  // Spacing of the device; a low quantile instead of the minimum, since drivers of 3D LiDARs round angles.
  const auto spacing = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 10);
  std::nth_element(known.begin(), spacing, known.end());
  for (float& sine : sines)
    if (sine > 1.5F * *spacing) sine = 0.0F;
  return sines;
}

/// Returns whether the range continues the surface of two beams: `near` is adjacent, `far` the next one, `sine` that of
/// the angle between any two consecutive ones.
bool continuesSurface(float range, float near, float far, float sine, const MixedPixelModel& model) {
  const float predicted_inverse = 2.0F * std::sqrt(1.0F - sine * sine) / near - 1.0F / far;
  if (!(predicted_inverse > 0.0F)) return false;
  const float predicted = 1.0F / predicted_inverse;
  // Roughness has a larger effect on the range the more the surface is inclined to the beam.
  const float slope = std::abs(near - far) / (near * sine);
  const float scale = range * range / (near * near);
  const float noise = model.range_sigma * (1.0F + 2.3F * scale) + model.roughness * std::min(slope, 20.0F) * scale;
  return std::abs(range - predicted) < kGate * noise + model.roughness;
}

bool isBetween(float value, float a, float b, float margin) {
  return value > std::min(a, b) + margin && value < std::max(a, b) - margin;
}

}  // namespace

std::vector<std::uint8_t> findMixedPixels(const Scan& scan, const MixedPixelModel& model) {
  const std::vector<Beam>& beams = scan.beams;
  std::vector<std::uint8_t> mixed(beams.size(), 0);
  if (beams.size() < 4) return mixed;
  const std::vector<float> sines = neighbourSines(scan);
  for (std::size_t i = 1; i + 1 < beams.size(); ++i) {
    if (sines[i - 1] == 0.0F || sines[i] == 0.0F) continue;
    const float range = beams[i].range, before = beams[i - 1].range, after = beams[i + 1].range;
    if (!isBetween(range, before, after, model.min_jump)) continue;
    const float sine = sines[i];
    const bool has_left = i >= 2 && sines[i - 2] != 0.0F, has_right = i + 2 < beams.size() && sines[i + 1] != 0.0F;
    const bool left = has_left && continuesSurface(range, before, beams[i - 2].range, sine, model);
    const bool right = has_right && continuesSurface(range, after, beams[i + 2].range, sine, model);
    const float middle = 2.0F * std::sqrt(1.0F - sine * sine) / (1.0F / before + 1.0F / after);
    const bool inside = std::abs(range - middle) < kGate * model.range_sigma && has_left && has_right &&
                        continuesSurface(after, before, beams[i - 2].range, sine, model);
    mixed[i] = (has_left || has_right) && !left && !right && !inside ? 1 : 0;
  }
  return mixed;
}

}  // namespace laser_mapper
