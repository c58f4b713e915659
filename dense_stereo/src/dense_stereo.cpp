// SPDX-License-Identifier: BSD-3-Clause
#include "dense_stereo/dense_stereo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "own_method.hpp"
#include "padded.hpp"
#include "pair_check.hpp"
#include "row_offset.hpp"
#include "sgm/descriptors.hpp"
#include "sgm/sgm_matcher.hpp"

namespace dense_stereo {

using urban_nav_core::Health;
using urban_nav_core::ImageView;

namespace {

constexpr double kLittle = 0.1;             // share of the pixels
constexpr double kMatchedIfSwapped = 0.25;  // share of the pixels
constexpr double kWellMatched = 0.5;        // share of the pixels
constexpr double kLargestRowOffset = 0.5;   // px
constexpr double kEqualExposure = 0.05;     // relative: typical difference between two views of a scene

std::unique_ptr<Matcher> makeOwnMatcher(const Parameters& parameters) {
  requireOwnMethod(parameters);
  return std::make_unique<SgmMatcher>(parameters);
}

}  // namespace

const char* toString(Reason reason) {
  static constexpr const char* kNames[] = {"none",    "image_missing", "sizes_differ",     "no_contrast",
                                           "swapped", "rows_disagree", "exposure_differs", "little_matched"};
  return kNames[static_cast<std::size_t>(reason)];
}

class DenseStereo::Implementation {
 public:
  Implementation(const Parameters& parameters, std::unique_ptr<Matcher> matcher)
      : disparities_(parameters.disparities), matcher_(matcher ? std::move(matcher) : makeOwnMatcher(parameters)) {}

  const StereoResult& process(const urban_nav_core::StereoPair& pair) {
    PairCheck check = checkPair(pair);
    // Images of different scenes may appear exchanged by chance; truly exchanged ones match after swapping.
    if (check.reason == Reason::Swapped && matchShare({pair.stamp, pair.right, pair.left}) < kMatchedIfSwapped)
      check = checkPair(pair, false);
    begin(pair.left, check);
    if (!check.usable) return result_;
    copy(pair.left, 1.0, 0.0, left_);
    const bool compensate = std::abs(check.exposure - 1.0) > kEqualExposure;
    copy(pair.right, compensate ? check.exposure : 1.0, compensate ? check.offset : 0.0, right_);
    matcher_->match({left_, right_}, result_.image);
    count();
    checkRows();
    return result_;
  }

 private:
  /// Returns the share of matched pixels.
  double matchShare(const urban_nav_core::StereoPair& pair) {
    begin(pair.left, PairCheck());
    copy(pair.left, 1.0, 0.0, left_);
    copy(pair.right, 1.0, 0.0, right_);
    matcher_->match({left_, right_}, result_.image);
    count();
    return result_.answered;
  }

  void begin(const ImageView& left, const PairCheck& check) {
    DisparityImage& image = result_.image;
    image.width = std::max(left.width, 0);
    image.height = std::max(left.height, 0);
    const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    image.disparity.assign(pixels, DisparityImage::kInvalid);
    image.variance.assign(pixels, 0.0F);
    result_.status.health = check.usable ? check.reason == Reason::None ? Health::Ok : Health::Degraded : Health::Lost;
    result_.status.reason = static_cast<int>(check.reason);
    result_.status.sentence = check.sentence;
    result_.answered = 0.0;
    result_.exposure = check.exposure;
    result_.row_offset = 0.0;
  }

  void copy(const ImageView& from, double gain, double offset, Padded<std::uint8_t>& to) const {
    to.resize(from.width, from.height);
    std::array<std::uint8_t, 256> levels{};
    for (std::size_t i = 0; i < levels.size(); ++i)
      levels[i] = static_cast<std::uint8_t>(std::clamp(std::lround(gain * static_cast<double>(i) + offset), 0L, 255L));
    const bool same = gain == 1.0 && offset == 0.0;
    for (int v = 0; v < from.height; ++v) {
      const std::uint8_t* in = from.row(v);
      if (same) std::memcpy(to.row(v), in, static_cast<std::size_t>(from.width));
      else std::transform(in, in + from.width, to.row(v), [&levels](std::uint8_t p) { return levels[p]; });
    }
    extendRows(to);
  }

  void count() {
    const DisparityImage& image = result_.image;
    const auto valid = std::count_if(image.disparity.begin(), image.disparity.end(), [](float d) { return d >= 0.0F; });
    result_.answered = static_cast<double>(valid) / static_cast<double>(image.disparity.size());
    if (result_.answered >= kLittle || result_.status.health != Health::Ok) return;
    char text[80];
    std::snprintf(text, sizeof text, "%.1f %% of the pixels matched", 100.0 * result_.answered);
    result_.status = {Health::Degraded, static_cast<int>(Reason::LittleMatched), text};
  }

  /// Detects misaligned rows. Rectified images agree to a few tenths of a row; beyond half a row disparities at slanted
  /// edges are wrong, beyond two few pixels match.
  void checkRows() {
    if (result_.answered > kWellMatched) {
      result_.row_offset = matchedRowOffset(left_, right_, result_.image).value_or(0.0);
    } else {
      result_.row_offset = searchedRowOffset(left_, right_, disparities_).value_or(0);
    }
    if (std::abs(result_.row_offset) < kLargestRowOffset) return;
    char text[100];
    std::snprintf(text, sizeof text, "rows are misaligned: the right image is %.1f px %s than the left one",
                  std::abs(result_.row_offset), result_.row_offset > 0.0 ? "lower" : "higher");
    result_.status = {Health::Degraded, static_cast<int>(Reason::RowsDisagree), text};
  }

  int disparities_;
  std::unique_ptr<Matcher> matcher_;
  Padded<std::uint8_t> left_, right_;
  StereoResult result_;
};

DenseStereo::DenseStereo(const Parameters& parameters, std::unique_ptr<Matcher> matcher)
    : implementation_(std::make_unique<Implementation>(parameters, std::move(matcher))) {}
DenseStereo::~DenseStereo() = default;
DenseStereo::DenseStereo(DenseStereo&&) noexcept = default;
DenseStereo& DenseStereo::operator=(DenseStereo&&) noexcept = default;

const StereoResult& DenseStereo::process(const urban_nav_core::StereoPair& pair) {
  return implementation_->process(pair);
}

}  // namespace dense_stereo
