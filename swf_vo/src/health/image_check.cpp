// SPDX-License-Identifier: BSD-3-Clause
#include "health/image_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "edge_width.hpp"
#include "urban_nav_core/image/exchanged.hpp"

namespace swf_vo {

using urban_nav_core::ImageView;
using urban_nav_core::looksExchanged;
using urban_nav_core::StereoPair;

namespace {

constexpr int kCheckColumnStep = 8;
constexpr int kRowStep = 4;
// Below this contrast an 8-bit image has no corner above its noise (FAST at its lowest threshold needs 3 grey levels of
// contrast).
constexpr double kDarkContrast = 2.0;
// Matching removes mean and gain; beyond a factor of 1.6 between frames, saturation begins to move corners.
constexpr double kExposureRatio = 1.6;
// A loss of focus over this number of frames is treated as permanent and becomes the reference.
constexpr int kLongestBlur = 50;
// An image of which half is suddenly saturated is as unusable as a black one: matches in the remainder are wrong or
// missing, and tracks should be kept until the light changes back. A lasting change becomes the reference at
// kWhiteRate.
constexpr int kWhiteGrey = 250;
constexpr double kWhiteShare = 0.5, kWhiteRate = 0.01;

// Returns the sum of absolute differences of two samples; 0 for samples of different size.
std::int64_t distance(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  std::int64_t sum = 0;
  if (a.size() != b.size()) return 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
  return sum;
}

}  // namespace

ImageCheck::Figures ImageCheck::measure(const ImageView& image, std::vector<std::uint8_t>& sample) const {
  const int columns = (image.width - 1) / kCheckColumnStep, rows = image.height / kRowStep;
  sample.resize(static_cast<std::size_t>(std::max(columns, 0)) * static_cast<std::size_t>(std::max(rows, 0)));
  if (sample.empty()) return {};
  std::int64_t sum = 0, squares = 0, clipped = 0;
  std::size_t at = 0;
  for (int r = 0; r < rows; ++r) {
    const std::uint8_t* row = image.row(r * kRowStep);
    for (int c = 0; c < columns; ++c) {
      const int value = row[c * kCheckColumnStep];
      sample[at++] = static_cast<std::uint8_t>(value);
      sum += value;
      clipped += value >= kWhiteGrey ? 1 : 0;
      squares += value * value;
    }
  }
  const double n = static_cast<double>(sample.size());
  Figures figures;
  figures.brightness = static_cast<double>(sum) / n;
  figures.white = static_cast<double>(clipped) / n;
  figures.contrast =
      std::sqrt(std::max(0.0, static_cast<double>(squares) / n - figures.brightness * figures.brightness));
  figures.edges = edgeVariance(image);
  return figures;
}

ImageVerdict ImageCheck::check(const StereoPair& pair, bool was_degraded) {
  ImageVerdict verdict;
  const bool same_size = pair.left.width == pair.right.width && pair.left.height == pair.right.height;
  if (pair.left.empty() || pair.right.empty() || !same_size) {
    verdict.usable = false;
    verdict.reason = Reason::ImageMissing;
    return verdict;
  }
  const Figures left = measure(pair.left, left_), right = measure(pair.right, right_);
  verdict.brightness = 0.5 * (left.brightness + right.brightness);
  verdict.contrast = std::min(left.contrast, right.contrast);
  verdict.edges = {left.edges, right.edges};

  // Camera noise changes at least one of thousands of pixels, even in a static scene.
  const bool frozen = !left_.empty() && (left_ == last_left_ || right_ == last_right_);
  const bool crossed = distance(left_, last_right_) + distance(right_, last_left_) <
                       distance(left_, last_left_) + distance(right_, last_right_);
  left_.swap(last_left_);
  right_.swap(last_right_);
  if (verdict.contrast < kDarkContrast) {
    verdict.usable = false;
    verdict.reason = Reason::Dark;
    return verdict;
  }
  if (frozen) {
    verdict.usable = false;
    verdict.reason = Reason::Frozen;
    return verdict;
  }

  const double ratio = usual_brightness_ > 0.0 ? (verdict.brightness + 1.0) / (usual_brightness_ + 1.0) : 1.0;
  const bool washed_out = ratio > kExposureRatio && std::max(left.white, right.white) > kWhiteShare;
  if (washed_out) {
    usual_brightness_ += kWhiteRate * (verdict.brightness - usual_brightness_);
    verdict.usable = false;
    verdict.reason = Reason::ExposureJump;
    return verdict;
  }
  if (ratio > kExposureRatio || ratio < 1.0 / kExposureRatio) verdict.reason = Reason::ExposureJump;
  const bool first = usual_brightness_ < 0.0;
  const bool wider = !first && !widening(verdict.edges, usual_edges_).isZero();
  blurred_ = wider ? blurred_ + 1 : 0;
  const bool is_blurred = blurred_ > 0 && blurred_ <= kLongestBlur;
  if (is_blurred) verdict.reason = Reason::Blurred;
  if ((was_degraded || crossed || first) && looksExchanged(pair.left, pair.right)) {
    verdict.exchange = true;
    verdict.edges = {right.edges, left.edges};
    verdict.reason = Reason::Swapped;
  }
  // Lasting changes become the reference: auto-exposure converges.
  const double rate = first || blurred_ > 0 ? 1.0 : 0.1;
  if (!is_blurred) {
    usual_edges_.left += rate * (left.edges - usual_edges_.left);
    usual_edges_.right += rate * (right.edges - usual_edges_.right);
  }
  usual_brightness_ =
      usual_brightness_ < 0.0 ? verdict.brightness : usual_brightness_ + 0.3 * (verdict.brightness - usual_brightness_);
  return verdict;
}

void ImageCheck::archive(urban_nav_core::Archive& archive) {
  archive(last_left_, last_right_, usual_brightness_, usual_edges_.left, usual_edges_.right, blurred_);
}

}  // namespace swf_vo
