// SPDX-License-Identifier: BSD-3-Clause
#include "health/corruption.hpp"

#include <algorithm>
#include <opencv2/core/hal/intrin.hpp>

namespace swf_vo {

using urban_nav_core::ImageView;
using urban_nav_core::StereoPair;

namespace {

// Length of a segment, px along a row; short enough for rows bent by rectification.
constexpr int kLength = 32;
constexpr int kCorruptionColumnStep = 64, kCorruptionRowStep = 4;
// Neighbouring random bytes differ by 85 grey levels on average, and over a segment by more than 60 almost always;
// below 16 the roughness may be camera noise.
constexpr unsigned kLeastRough = 16 * kLength, kRandomBytes = 60 * kLength;
// Threshold between the shares in good and in corrupted images (see the header).
constexpr double kCorruptedShare = 0.025;
constexpr int kFewestLines =
    4;  // segments: a small image has a few tens, and one of them may be an edge along the rows
// Rows: with 60 % corrupted, one in twenty has only corrupted neighbours, and is detected by kRandomBytes itself.
constexpr int kCorruptionReach = 3;
constexpr int kSaturatedGrey = 250;

unsigned difference(const std::uint8_t* p, const std::uint8_t* q) {
  return cv::v_reduce_sad(cv::v_load(p), cv::v_load(q)) + cv::v_reduce_sad(cv::v_load(p + 16), cv::v_load(q + 16));
}

unsigned roughness(const std::uint8_t* p) { return difference(p, p + 1); }

bool isRougher(unsigned roughness, unsigned other) { return roughness > kLeastRough && 2 * roughness > 5 * other; }

}  // namespace

bool looksCorrupted(const ImageView& image) {
  if (image.empty()) return false;
  int places = 0, corrupted = 0;
  for (int v = 0; v + 1 < image.height; v += kCorruptionRowStep) {
    const std::uint8_t *upper = image.row(v), *lower = image.row(v + 1);
    for (int u = 0; u + kLength < image.width; u += kCorruptionColumnStep, ++places) {
      const unsigned a = roughness(upper + u), b = roughness(lower + u);
      const bool torn = isRougher(std::max(a, b), std::min(a, b));
      const bool random = std::min({a, b, difference(upper + u, lower + u)}) > kRandomBytes;
      corrupted += torn || random ? 1 : 0;
    }
  }
  return corrupted >= kFewestLines && corrupted > kCorruptedShare * places;
}

CorruptRowRepair::CorruptRowRepair(int width, int height)
    : width_(width),
      height_(height),
      left_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      right_(left_.size()),
      roughness_(static_cast<std::size_t>(height)),
      corrupted_(static_cast<std::size_t>(height)) {}

CorruptRowRepair::Repaired CorruptRowRepair::repair(const StereoPair& pair) {
  Repaired result{pair, false};
  const auto repairOne = [&](ImageView& image, std::vector<std::uint8_t>& pixels) {
    if (image.width != width_ || image.height != height_ || !looksCorrupted(image)) return;
    repair(image, pixels);
    image = {pixels.data(), width_, height_, width_};
    result.corrupted = true;
  };
  repairOne(result.pair.left, left_);
  repairOne(result.pair.right, right_);
  return result;
}

void CorruptRowRepair::repair(const ImageView& image, std::vector<std::uint8_t>& pixels) {
  for (int v = 0; v < height_; ++v)
    std::copy_n(image.row(v), width_, pixels.begin() + static_cast<std::ptrdiff_t>(v) * width_);
  for (int begin = 0; begin < width_; begin += kLength) {
    const int count = std::min(kLength, width_ - begin);
    findCorrupted(image, std::min(begin, width_ - kLength - 1));
    bridge(pixels, begin, count);
  }
}

void CorruptRowRepair::findCorrupted(const ImageView& image, int column) {
  for (int v = 0; v < height_; ++v) roughness_[static_cast<std::size_t>(v)] = roughness(image.row(v) + column);
  for (int v = 0; v < height_; ++v) {
    const unsigned here = roughness_[static_cast<std::size_t>(v)];
    unsigned least = here;
    for (int w = std::max(0, v - kCorruptionReach); w < std::min(height_, v + kCorruptionReach + 1); ++w) {
      const unsigned there = roughness_[static_cast<std::size_t>(w)];
      // A row without texture may be a missing one, unless it shows a white sky.
      if (there > 0 || image.at(column, w) >= kSaturatedGrey) least = std::min(least, there);
    }
    corrupted_[static_cast<std::size_t>(v)] = here > kRandomBytes || isRougher(here, least);
  }
}

void CorruptRowRepair::bridge(std::vector<std::uint8_t>& pixels, int column, int count) const {
  const auto rowAt = [&](int v) { return pixels.begin() + static_cast<std::ptrdiff_t>(v) * width_ + column; };
  int above = -1;
  for (int v = 0; v <= height_; ++v) {
    if (v < height_ && corrupted_[static_cast<std::size_t>(v)]) continue;
    const int below = v;
    const bool has_above = above >= 0, has_below = below < height_;
    for (int w = above + 1; w < below && (has_above || has_below); ++w) {
      const auto from = rowAt(has_above ? above : below), to = rowAt(has_below ? below : above);
      const int share = 256 * (w - above) / (below - above);
      std::transform(from, from + count, to, rowAt(w), [share](int a, int b) {
        return static_cast<std::uint8_t>((a * (256 - share) + b * share + 128) / 256);
      });
    }
    above = v;
  }
}

}  // namespace swf_vo
