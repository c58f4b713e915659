// SPDX-License-Identifier: BSD-3-Clause
#include "filter/unsupported_regions.hpp"

#include <algorithm>
#include <utility>

#include "sgm/bytes.hpp"

namespace dense_stereo {

namespace {

constexpr float kEnoughInformation = 28.0F;  // squared gradients relative to noise; images of pure noise give 22
constexpr float kEnoughDistance = 50.0F;     // of the cost of the second best disparity
constexpr float kRoundingNoise = 0.06F;      // grey levels^2, of two smoothed images rounded to integers
constexpr double kLeastShare = 0.15;         // of a window's pixels
constexpr int kFlatRange = 4;                // grey levels in 3x3 px
constexpr int kSaturated = 254;
constexpr int kOutlineReach = 8;   // px, of the windows of census and alignment
constexpr int kOutlineRange = 32;  // grey levels in 3x3 px, of an outline

}  // namespace

void UnsupportedRegions::remove(const Padded<std::uint8_t>& left, const Winners& winners, DisparityField& field) {
  const int width = left.width(), height = left.height();
  flat_.resize(width, height);
  evidence_.resize(width, height);
  sums_.resize(width, height);
  column_.resize(static_cast<std::size_t>(width));
  outline_.resize(width, height);
  beside_.resize(width, height);
  removed_.resize(width, height);
  grown_.resize(width, height);
  markFlat(left);
  markBesideOutlines();
  markEvidence(left, winners, field);
  sumWindows();
  markPoorWindows();
  sumWindows();
  for (int v = 0; v < height; ++v) {
    const std::uint8_t* flat = flat_.row(v);
    const std::uint16_t* poor = sums_.row(v);
    std::uint8_t* removed = removed_.row(v);
    for (int u = 0; u < width; ++u) removed[u] = poor[u] != 0 && flat[u] != 0 ? 255 : 0;
  }
  growThroughFlat();
  growOverBlur(left);
  for (int v = 0; v < height; ++v) {
    float* d = field.disparity.row(v);
    const std::uint8_t* removed = removed_.row(v);
    for (int u = 0; u < width; ++u)
      if (removed[u] != 0) d[u] = DisparityField::kInvalid;
  }
}

/// Grows removed_ by one pixel per iteration, through flat pixels beside outlines.
void UnsupportedRegions::growThroughFlat() {
  for (int round = 0; round < kOutlineReach; ++round) {
    for (int v = 0; v < removed_.height(); ++v) {
      const std::uint8_t* rows[3] = {removed_.clampedRow(v - 1), removed_.row(v), removed_.clampedRow(v + 1)};
      for (int u = 0; u < removed_.width(); u += 16) {
        Bytes near = Bytes::splat(0);
        for (const std::uint8_t* row : rows)
          for (int k = -1; k <= 1; ++k) near = either(near, Bytes::load(row + u + k));
        either(Bytes::load(rows[1] + u), both(near, Bytes::load(beside_.row(v) + u))).store(grown_.row(v) + u);
      }
    }
    std::swap(removed_, grown_);
  }
}

/// flat_ is 255 where the surrounding 3x3 pixels are equal up to noise, outline_ where they differ much.
void UnsupportedRegions::markFlat(const Padded<std::uint8_t>& left) {
  const Bytes range = Bytes::splat(kFlatRange), outline = Bytes::splat(kOutlineRange - 1);
  const Bytes zero = Bytes::splat(0), all = Bytes::splat(255);
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
      exclusiveOr(equal(subtract(spread, outline), zero), all).store(outline_.row(v) + u);
    }
  }
}

/// beside_ is 255 at flat pixels whose windows contain an outline.
void UnsupportedRegions::markBesideOutlines() {
  const int height = outline_.height(), width = outline_.width();
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; u += 16) {
      Bytes near = Bytes::load(outline_.row(v) + u);
      for (int k = 1; k <= kOutlineReach; ++k)
        near = either(near, either(Bytes::load(outline_.row(v) + u - k), Bytes::load(outline_.row(v) + u + k)));
      near.store(grown_.row(v) + u);
    }
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; u += 16) {
      Bytes near = Bytes::load(grown_.row(v) + u);
      for (int k = 1; k <= kOutlineReach; ++k)
        near =
            either(near, either(Bytes::load(grown_.clampedRow(v - k) + u), Bytes::load(grown_.clampedRow(v + k) + u)));
      both(near, Bytes::load(flat_.row(v) + u)).store(beside_.row(v) + u);
    }
}

/// Evidence is 1 or 0; pixels without it count as flat afterwards.
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
      const float scale = kEnoughInformation * (noise[u] + kRoundingNoise);
      const auto distance = static_cast<float>(rival[u] - cost[u]);
      const bool is_enough = kEnoughDistance * information[u] + distance * scale > kEnoughDistance * scale;
      const bool is_saturated = flat[u] != 0 && pixels[u] >= kSaturated;
      const bool has_evidence = d[u] >= 0.0F && is_enough && !is_saturated;
      evidence[u] = has_evidence ? 1 : 0;
      if (!has_evidence) flat[u] = 255;
    }
  }
}

/// Computes sums of evidence_ over the window around each pixel, clipped at the borders.
void UnsupportedRegions::sumWindows() {
  const int width = evidence_.width(), height = evidence_.height();
  std::fill(column_.begin(), column_.end(), std::uint16_t{0});
  for (int v = -kRadius; v < height; ++v) {
    const std::uint8_t* added = evidence_.row(std::min(v + kRadius, height - 1));
    const std::uint8_t* removed = evidence_.row(std::max(v - kRadius - 1, 0));
    const int add = v + kRadius < height ? 1 : 0, remove = v - kRadius - 1 >= 0 ? 1 : 0;
    for (int u = 0; u < width; ++u)
      column_[static_cast<std::size_t>(u)] =
          static_cast<std::uint16_t>(column_[static_cast<std::size_t>(u)] + add * added[u] - remove * removed[u]);
    if (v < 0) continue;
    std::uint16_t* sums = sums_.row(v);
    int sum = 0;
    for (int u = -kRadius; u < width; ++u) {
      if (u + kRadius < width) sum += column_[static_cast<std::size_t>(u + kRadius)];
      if (u - kRadius - 1 >= 0) sum -= column_[static_cast<std::size_t>(u - kRadius - 1)];
      if (u >= 0) sums[u] = static_cast<std::uint16_t>(sum);
    }
  }
}

/// Afterwards evidence_ is 1 at the centres of windows without enough evidence.
void UnsupportedRegions::markPoorWindows() {
  const int width = evidence_.width(), height = evidence_.height();
  for (int v = 0; v < height; ++v) {
    const int rows = std::min(v + kRadius, height - 1) - std::max(v - kRadius, 0) + 1;
    const std::uint16_t* sums = sums_.row(v);
    std::uint8_t* poor = evidence_.row(v);
    for (int u = 0; u < width; ++u) {
      const int columns = std::min(u + kRadius, width - 1) - std::max(u - kRadius, 0) + 1;
      poor[u] = sums[u] <= kLeastShare * rows * columns ? 1 : 0;
    }
  }
}

/// Grows removed_ by a pixel across the blurred outline: to pixels whose brightness lies between that of their removed
/// neighbour and that of the pixel two further on, which differs much, and is closer to the former.
void UnsupportedRegions::growOverBlur(const Padded<std::uint8_t>& left) {
  const Bytes zero = Bytes::splat(0), all = Bytes::splat(255), contrast = Bytes::splat(kOutlineRange - 1),
              noise = Bytes::splat(kFlatRange);
  constexpr int kDirections[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (int v = 0; v < removed_.height(); ++v) {
    for (int u = 0; u < removed_.width(); u += 16) {
      const Bytes here = Bytes::load(left.row(v) + u);
      Bytes grown = Bytes::load(removed_.row(v) + u);
      for (const auto& [du, dv] : kDirections) {
        const Bytes neighbour = Bytes::load(left.clampedRow(v + dv) + u + du);
        const Bytes beyond = Bytes::load(left.clampedRow(v - 2 * dv) + u - 2 * du);
        const Bytes to_neighbour = absoluteDifference(here, neighbour), to_beyond = absoluteDifference(here, beyond);
        const Bytes apart = absoluteDifference(neighbour, beyond);
        const Bytes is_nearer = equal(subtract(to_neighbour, to_beyond), zero);
        const Bytes is_between = equal(subtract(add(to_neighbour, to_beyond), add(apart, noise)), zero);
        const Bytes differs = exclusiveOr(equal(subtract(apart, contrast), zero), all);
        const Bytes is_removed = Bytes::load(removed_.clampedRow(v + dv) + u + du);
        grown = either(grown, both(is_removed, both(both(is_nearer, is_between), differs)));
      }
      grown.store(grown_.row(v) + u);
    }
  }
  std::swap(removed_, grown_);
}

}  // namespace dense_stereo
