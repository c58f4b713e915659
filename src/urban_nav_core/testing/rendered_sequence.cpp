// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/rendered_sequence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace urban_nav_core::testing {
namespace {

/// Standard normal quantiles at the centres of 4096 equally probable intervals, by Newton's method.
const std::array<float, 4096>& normalTable() {
  static const std::array<float, 4096> table = [] {
    std::array<float, 4096> values{};
    double z = -3.7;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double wanted = (static_cast<double>(i) + 0.5) / static_cast<double>(values.size());
      for (int k = 0; k < 30; ++k) {
        const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * 3.14159265358979323846);
        z += std::clamp((wanted - 0.5 * std::erfc(-z / std::sqrt(2.0))) / density, -0.5, 0.5);
      }
      values[i] = static_cast<float>(z);
    }
    return values;
  }();
  return table;
}

/// SplitMix64 (Steele et al. 2014): 64 random bits per count.
std::uint64_t toBits(std::uint64_t count) {
  std::uint64_t z = count * 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

}  // namespace

StereoCamera makeCamera(const RenderCamera& rendered) {
  StereoCamera camera;
  camera.left = {rendered.fx, rendered.fy, rendered.cx, rendered.cy, rendered.width, rendered.height};
  camera.baseline = rendered.baseline;
  return camera;
}

RenderedSequence::RenderedSequence(std::function<Scene(double)> scene, Motion motion, const SequenceOptions& options)
    : scene_(std::move(scene)), motion_(std::move(motion)), options_(options), renderer_(options.camera) {}

RenderedSequence::RenderedSequence(Scene scene, Motion motion, const SequenceOptions& options)
    : still_(std::move(scene)), motion_(std::move(motion)), options_(options), renderer_(options.camera) {}

StampNs RenderedSequence::stamp(int i) const { return options_.first_stamp + std::llround(time(i) * 1e9); }

void RenderedSequence::expose(const std::vector<float>& radiance, double gain, double noise, std::uint64_t stream,
                              GreyImage& image) const {
  image.width = options_.camera.width;
  image.height = options_.camera.height;
  image.pixels.resize(radiance.size());
  const std::array<float, 4096>& normal = normalTable();
  const auto factor = static_cast<float>(gain), spread = static_cast<float>(noise);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    bits = i % 5 == 0 ? toBits((stream << 32U) + i) : bits >> 12U;
    const float grey = factor * radiance[i] + spread * normal[bits & 4095U];
    image.pixels[i] = static_cast<std::uint8_t>(std::clamp(grey + 0.5F, 0.0F, 255.0F));
  }
}

void RenderedSequence::addRadiance(double t, float share) {
  const Pose T_world_left = motion_(t);
  const Pose T_world_right = T_world_left * Pose(Quaterniond::Identity(), Vector3d(options_.camera.baseline, 0.0, 0.0));
  if (scene_) still_ = scene_(t);
  for (const auto& [T_world_camera, sum] :
       {std::pair(&T_world_left, &radiance_left_), {&T_world_right, &radiance_right_}}) {
    const std::vector<float>& radiance = renderer_.draw(still_, *T_world_camera);
    sum->resize(radiance.size(), 0.0F);
    for (std::size_t i = 0; i < radiance.size(); ++i) (*sum)[i] += share * radiance[i];
  }
}

void RenderedSequence::draw(int i) {
  constexpr int kMoments = 8;
  if (i == drawn_) return;
  radiance_left_.clear();
  radiance_right_.clear();
  const int moments = options_.exposure > 0.0 ? kMoments : 1;
  for (int k = 0; k < moments; ++k) {
    const double t = time(i) + options_.exposure * ((k + 0.5) / moments - 0.5);
    addRadiance(std::max(0.0, t), 1.0F / static_cast<float>(moments));
  }
  drawn_ = i;
}

const StereoFrame& RenderedSequence::frame(int i, double noise) {
  draw(i);
  const double gain = options_.gain ? options_.gain(time(i)) : 1.0;
  const std::uint64_t stream =
      toBits((static_cast<std::uint64_t>(options_.seed) << 32U) + static_cast<std::uint64_t>(i)) & 0x7FFFFFFFU;
  frame_.stamp = stamp(i);
  expose(radiance_left_, gain, noise, 2 * stream, frame_.left);
  expose(radiance_right_, gain, noise, 2 * stream + 1, frame_.right);
  return frame_;
}

}  // namespace urban_nav_core::testing
