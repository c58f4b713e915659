// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "urban_nav_core/types/stereo_pair.hpp"

namespace dense_stereo::testing_support {

/// A textured plane seen by both cameras, with its exact disparities and camera noise of one grey level.
class SlantedPair {
 public:
  /// Disparity `middle` in the middle of the left image, plus `along` for each column and `down` for each row;
  /// `gain`: brightness of the right image.
  SlantedPair(int width, int height, double middle, double along, double down, double gain, unsigned seed = 1)
      : width_(width), height_(height), middle_(middle), along_(along), down_(down) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> phase(0.0, 6.283), angle(-1.0, 1.0);
    for (Wave& wave : waves_) wave = {0.15 + 0.9 * std::abs(angle(random)), 0.9 * angle(random), phase(random)};
    std::normal_distribution<double> noise(0.0, 1.0);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) left_.push_back(level(value(u, v) + noise(random)));
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) right_.push_back(level(gain * value(leftColumn(u, v), v) + noise(random)));
  }

  double disparity(double u, double v) const {
    return middle_ + along_ * (u - 0.5 * width_) + down_ * (v - 0.5 * height_);
  }
  urban_nav_core::StereoPair pair() const {
    return {0, {left_.data(), width_, height_, width_}, {right_.data(), width_, height_, width_}};
  }

 private:
  struct Wave {
    double u, v, phase;  // rad/px
  };

  /// Returns the column of the left image for column u of the right one: u = left - disparity(left).
  double leftColumn(double u, double v) const { return (u + disparity(0.0, v)) / (1.0 - along_); }
  double value(double u, double v) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::sin(wave.u * u + wave.v * v + wave.phase);
    return 120.0 + 18.0 * sum;
  }
  static std::uint8_t level(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
  }

  int width_, height_;
  double middle_, along_, down_;
  Wave waves_[12];
  std::vector<std::uint8_t> left_, right_;
};

}  // namespace dense_stereo::testing_support
