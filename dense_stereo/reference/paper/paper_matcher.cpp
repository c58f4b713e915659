// SPDX-License-Identifier: BSD-3-Clause
#include "paper/paper_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "dense_stereo_paper/paper_matcher.hpp"
#include "sgm/semi_global.hpp"

namespace dense_stereo {

namespace {

constexpr int kLanesOfWords = 8;
constexpr double kLeastRise = 0.06;     // of the second minimum above the first, relative: flatter curves are ambiguous
constexpr float kLeastSigmaPx = 0.12F;  // pixel locking of parabolas through sums of absolute differences
constexpr float kSigmaPerFlatness = 0.06F;

struct CurveMinimum {
  int disparity = 0, score = 0;
  int rival = 65535;  ///< smallest score at disparities that differ by more than one
};

CurveMinimum findMinimum(const std::uint16_t* scores, int disparities) {
  CurveMinimum minimum;
  minimum.score = 65536;
  for (int d = 0; d < disparities; d += kLanesOfWords) {
    const auto [score, at] = findLeast(Words::load(scores + d));
    if (score >= minimum.score) continue;
    minimum.score = score;
    minimum.disparity = d + at;
  }
  for (int d = 0; d < disparities; ++d)
    if (std::abs(d - minimum.disparity) > 1) minimum.rival = std::min<int>(minimum.rival, scores[d]);
  return minimum;
}

}  // namespace

std::unique_ptr<Matcher> makePaperMatcher(const Parameters& parameters) {
  if (parameters.method != "paper") return nullptr;
  return std::make_unique<PaperMatcher>(parameters);
}

void PaperMatcher::match(const MatcherInput& input, DisparityImage& image) {
  const int disparities = (parameters_.disparities + 15) / 16 * 16;
  filter_.apply(input.left, left_);
  filter_.apply(input.right, right_);
  whole_.resize(image.width, image.height);
  windows_.begin(left_, right_, disparities);
  for (int v = 0; v < image.height; ++v) matchRow(windows_.next(), v, disparities, image);
  components_.remove(whole_, parameters_.min_component);
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      if (whole_.row(v)[u] != Winners::kInvalid) continue;
      image.disparity[image.index(u, v)] = DisparityImage::kInvalid;
      image.variance[image.index(u, v)] = 0.0F;
    }
}

void PaperMatcher::matchRow(const ScoreRow& row, int v, int disparities, DisparityImage& image) {
  std::uint16_t* whole = whole_.row(v);
  const auto largest = static_cast<float>(parameters_.max_sigma * parameters_.max_sigma);
  for (int u = 0; u < image.width; ++u) {
    whole[u] = Winners::kInvalid;
    const std::uint16_t* scores = row.scores + static_cast<std::ptrdiff_t>(u) * disparities;
    const CurveMinimum minimum = findMinimum(scores, disparities);
    const int d = minimum.disparity;
    if (d > u || std::abs(row.right_disparity[u - d] - d) > 1) continue;
    if (minimum.rival < (1.0 + kLeastRise) * minimum.score) continue;
    const bool is_inside = d > 0 && d + 1 < disparities && d + 1 <= u;
    const int before = is_inside ? scores[d - 1] : 0, after = is_inside ? scores[d + 1] : 0;
    const auto curvature = static_cast<float>(is_inside ? before + after - 2 * minimum.score : 0);
    if (curvature <= 0.0F) continue;
    const float flatness = static_cast<float>(minimum.score) / curvature;
    const float sigma = kSigmaPerFlatness * flatness;
    const float variance = kLeastSigmaPx * kLeastSigmaPx + sigma * sigma;
    if (variance > largest) continue;
    whole[u] = static_cast<std::uint16_t>(d);
    const std::size_t at = image.index(u, v);
    image.disparity[at] = static_cast<float>(d) + 0.5F * static_cast<float>(before - after) / curvature;
    image.variance[at] = variance;
  }
}

}  // namespace dense_stereo
