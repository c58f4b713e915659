// SPDX-License-Identifier: BSD-3-Clause
#include "filter/unsupported_regions.hpp"

#include <algorithm>

#include "sgm/bytes.hpp"

namespace dense_stereo {

namespace {

constexpr float enough_information = 28.0F;  // squared gradients for each unit of noise; images of noise alone give 22
constexpr float enough_distance = 50.0F;     // of the rival's cost
constexpr float rounding_noise = 0.06F;      // grey levels^2, of two images with whole grey levels, smoothed
constexpr double least_share = 0.15;         // of a window's pixels
constexpr int flat_range = 4;                // grey levels in 3x3 px
constexpr int saturated = 254;

}  // namespace

void UnsupportedRegions::remove(const Padded<std::uint8_t>& left, const Winners& winners, DisparityField& field) {
  const int width = left.width(), height = left.height();
  flat_.resize(width, height);
  evidence_.resize(width, height);
  sums_.resize(width, height);
  column_.resize(static_cast<std::size_t>(width));
  markFlat(left);
  markEvidence(left, winners, field);
  sumWindows();
  markPoorWindows();
  sumWindows();
  for (int v = 0; v < height; ++v) {
    float* d = field.disparity.row(v);
    const std::uint8_t* flat = flat_.row(v);
    const std::uint16_t* poor = sums_.row(v);
    for (int u = 0; u < width; ++u)
      if (poor[u] != 0 && flat[u] != 0) d[u] = DisparityField::invalid;
  }
}

/// 255 where the 3x3 pixels around are equal but for noise.
void UnsupportedRegions::markFlat(const Padded<std::uint8_t>& left) {
  const Bytes range = Bytes::splat(flat_range), zero = Bytes::splat(0), all = Bytes::splat(255);
  for (int v = 0; v < left.height(); ++v) {
    const std::uint8_t* rows[3] = {left.clampedRow(v - 1), left.row(v), left.clampedRow(v + 1)};
    for (int u = 0; u < left.width(); u += 16) {
      Bytes least = all, greatest_complement = all;
      for (const std::uint8_t* row : rows)
        for (int k = -1; k <= 1; ++k) {
          const Bytes pixels = Bytes::load(row + u + k);
          least = min(least, pixels);
          greatest_complement = min(greatest_complement, exclusiveOr(pixels, all));
        }
      const Bytes spread = subtract(exclusiveOr(greatest_complement, all), least);
      equal(subtract(spread, range), zero).store(flat_.row(v) + u);
    }
  }
}

/// Evidence is 1 or 0; pixels without it count as flat from here on.
void UnsupportedRegions::markEvidence(const Padded<std::uint8_t>& left, const Winners& winners,
                                      const DisparityField& field) {
  for (int v = 0; v < left.height(); ++v) {
    const std::uint8_t* pixels = left.row(v);
    const std::uint8_t* cost = winners.cost.row(v);
    const std::uint8_t* rival = winners.rival.row(v);
    const float* d = field.disparity.row(v);
    const float* noise = field.noise.row(v);
    const float* information = field.information.row(v);
    std::uint8_t* flat = flat_.row(v);
    std::uint8_t* evidence = evidence_.row(v);
    for (int u = 0; u < left.width(); ++u) {
      const float scale = enough_information * (noise[u] + rounding_noise);
      const auto distance = static_cast<float>(rival[u] - cost[u]);
      const bool is_enough = enough_distance * information[u] + distance * scale > enough_distance * scale;
      const bool is_saturated = flat[u] != 0 && pixels[u] >= saturated;
      const bool has_evidence = d[u] >= 0.0F && is_enough && !is_saturated;
      evidence[u] = has_evidence ? 1 : 0;
      if (!has_evidence) flat[u] = 255;
    }
  }
}

/// Sums of evidence_ over the window around each pixel, cut off at the borders.
void UnsupportedRegions::sumWindows() {
  const int width = evidence_.width(), height = evidence_.height();
  std::fill(column_.begin(), column_.end(), std::uint16_t{0});
  for (int v = -radius; v < height; ++v) {
    const std::uint8_t* added = evidence_.row(std::min(v + radius, height - 1));
    const std::uint8_t* removed = evidence_.row(std::max(v - radius - 1, 0));
    const int add = v + radius < height ? 1 : 0, remove = v - radius - 1 >= 0 ? 1 : 0;
    for (int u = 0; u < width; ++u)
      column_[static_cast<std::size_t>(u)] =
          static_cast<std::uint16_t>(column_[static_cast<std::size_t>(u)] + add * added[u] - remove * removed[u]);
    if (v < 0) continue;
    std::uint16_t* sums = sums_.row(v);
    int sum = 0;
    for (int u = -radius; u < width; ++u) {
      if (u + radius < width) sum += column_[static_cast<std::size_t>(u + radius)];
      if (u - radius - 1 >= 0) sum -= column_[static_cast<std::size_t>(u - radius - 1)];
      if (u >= 0) sums[u] = static_cast<std::uint16_t>(sum);
    }
  }
}

/// From here on evidence_ is 1 in the middle of windows without enough evidence.
void UnsupportedRegions::markPoorWindows() {
  const int width = evidence_.width(), height = evidence_.height();
  for (int v = 0; v < height; ++v) {
    const int rows = std::min(v + radius, height - 1) - std::max(v - radius, 0) + 1;
    const std::uint16_t* sums = sums_.row(v);
    std::uint8_t* poor = evidence_.row(v);
    for (int u = 0; u < width; ++u) {
      const int columns = std::min(u + radius, width - 1) - std::max(u - radius, 0) + 1;
      poor[u] = sums[u] <= least_share * rows * columns ? 1 : 0;
    }
  }
}

}  // namespace dense_stereo
