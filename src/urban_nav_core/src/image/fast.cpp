// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/fast.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

namespace urban_nav_core {
namespace {

constexpr int kCircle = 16;
// Bresenham's circle of radius 3 from the bottom, counter-clockwise (Rosten and Drummond 2006, figure 1).
constexpr int kCircleU[kCircle] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
constexpr int kCircleV[kCircle] = {3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1, 0, 1, 2, 3};
constexpr int kLanes = 16;

/// Largest value that nine neighbours on the circle all reach: max over arcs of min over the arc. Arcs that begin at
/// k - 1 and at k, k odd, share eight places, so eight minima of eight serve all sixteen.
template <typename V, typename Min, typename Max>
inline V bestArc(const V* d, Min min, Max max) {
  V pair[8], quad[8];
  for (int i = 0; i < 8; ++i) pair[i] = min(d[2 * i + 1], d[(2 * i + 2) % kCircle]);
  for (int i = 0; i < 8; ++i) quad[i] = min(pair[i], pair[(i + 1) % 8]);
  V best = min(min(quad[0], quad[2]), max(d[0], d[9]));
  for (int i = 1; i < 8; ++i) {
    best = max(best, min(min(quad[i], quad[(i + 2) % 8]), max(d[2 * i], d[(2 * i + 9) % kCircle])));
  }
  return best;
}

/// Scores of three successive rows.
struct ScoreRows {
  const std::uint8_t* above;
  const std::uint8_t* here;
  const std::uint8_t* below;
};

std::uint8_t scoreOf(const std::uint8_t* pixel, const std::ptrdiff_t* offsets) {
  int brighter[kCircle], darker[kCircle];
  for (int i = 0; i < kCircle; ++i) {
    brighter[i] = std::max(pixel[offsets[i]] - pixel[0], 0);
    darker[i] = std::max(pixel[0] - pixel[offsets[i]], 0);
  }
  const auto min = [](int a, int b) { return std::min(a, b); };
  const auto max = [](int a, int b) { return std::max(a, b); };
  return static_cast<std::uint8_t>(std::max(bestArc(brighter, min, max), bestArc(darker, min, max)));
}

#if CV_SIMD128
using cv::v_uint8x16;

/// Scores of sixteen pixels; those that are no corner at the threshold get 0. Any nine neighbours on the circle hold
/// two neighbouring points of the compass: without such a pair in any lane the sixteen are done.
inline bool scoreSixteen(const std::uint8_t* pixel, const std::ptrdiff_t* offsets, const v_uint8x16& threshold,
                         std::uint8_t* scores) {
  const v_uint8x16 zero = cv::v_setzero_u8();
  const v_uint8x16 centre = cv::v_load(pixel);
  const v_uint8x16 above = centre + threshold, below = centre - threshold;  // saturating
  v_uint8x16 bright[4], dark[4];
  for (int i = 0; i < 4; ++i) {
    const v_uint8x16 p = cv::v_load(pixel + offsets[4 * i]);
    bright[i] = p - above;
    dark[i] = below - p;
  }
  const auto opposed = [](const v_uint8x16* d) { return cv::v_min(cv::v_max(d[0], d[2]), cv::v_max(d[1], d[3])); };
  const v_uint8x16 candidate = cv::v_max(opposed(bright), opposed(dark)) != zero;
  if (!cv::v_check_any(candidate)) {
    cv::v_store(scores, zero);
    return false;
  }
  const auto min = [](const v_uint8x16& a, const v_uint8x16& b) { return cv::v_min(a, b); };
  const auto max = [](const v_uint8x16& a, const v_uint8x16& b) { return cv::v_max(a, b); };
  v_uint8x16 d[kCircle];
  for (int i = 0; i < kCircle; ++i) d[i] = cv::v_load(pixel + offsets[i]) - centre;
  v_uint8x16 score = bestArc(d, min, max);
  for (int i = 0; i < kCircle; ++i) d[i] = centre - cv::v_load(pixel + offsets[i]);
  score = cv::v_max(score, bestArc(d, min, max));
  const v_uint8x16 is_corner = score > threshold;
  cv::v_store(scores, score & is_corner);
  return cv::v_check_any(is_corner);
}

/// Bit i is set where the score of pixel i is above zero and, if asked, a local maximum.
inline int keptOfSixteen(const ScoreRows& rows, int u, bool suppress) {
  const v_uint8x16 zero = cv::v_setzero_u8();
  const v_uint8x16 score = cv::v_load(rows.here + u);
  if (!cv::v_check_any(score != zero)) return 0;
  if (!suppress) return cv::v_signmask(score != zero);
  const v_uint8x16 before = cv::v_max(cv::v_max(cv::v_load(rows.above + u - 1), cv::v_load(rows.above + u)),
                                      cv::v_max(cv::v_load(rows.above + u + 1), cv::v_load(rows.here + u - 1)));
  const v_uint8x16 behind = cv::v_max(cv::v_max(cv::v_load(rows.below + u - 1), cv::v_load(rows.below + u)),
                                      cv::v_max(cv::v_load(rows.below + u + 1), cv::v_load(rows.here + u + 1)));
  return cv::v_signmask(((score - before) != zero) & ((behind - score) == zero));
}
#else
int keptOfSixteen(const ScoreRows& rows, int first, bool suppress) {
  int bits = 0;
  for (int i = 0; i < kLanes; ++i) {
    const int u = first + i;
    const int score = rows.here[u];
    const int before = std::max({rows.above[u - 1], rows.above[u], rows.above[u + 1], rows.here[u - 1]});
    const int behind = std::max({rows.below[u - 1], rows.below[u], rows.below[u + 1], rows.here[u + 1]});
    if (score != 0 && (!suppress || (score > before && score >= behind))) bits |= 1 << i;
  }
  return bits;
}
#endif

/// Scores of row v into scores[0...width): zero where there is no corner. Says whether there is one.
bool scoreRow(const ImageView& image, int v, int threshold, std::uint8_t* scores) {
  std::ptrdiff_t offsets[kCircle];
  for (int i = 0; i < kCircle; ++i) offsets[i] = kCircleV[i] * image.stride + kCircleU[i];
  const std::uint8_t* row = image.row(v);
  const int end = image.width - Fast::kRadius;
  bool any = false;
  int u = Fast::kRadius;
#if CV_SIMD128
  const v_uint8x16 threshold16 = cv::v_setall_u8(static_cast<std::uint8_t>(threshold));
  for (; u + kLanes <= end; u += kLanes) any |= scoreSixteen(row + u, offsets, threshold16, scores + u);
  if (u < end && end - Fast::kRadius >= kLanes) {  // some pixels twice, rather than bytes behind the row
    any |= scoreSixteen(row + end - kLanes, offsets, threshold16, scores + end - kLanes);
    u = end;
  }
#endif
  for (; u < end; ++u) {
    const std::uint8_t score = scoreOf(row + u, offsets);
    scores[u] = score > threshold ? score : std::uint8_t{0};
    any |= scores[u] != 0;
  }
  return any;
}

void collectRow(const ScoreRows& rows, int v, int width, bool suppress, std::vector<Corner>& corners) {
  for (int u = Fast::kRadius; u < width - Fast::kRadius; u += kLanes) {
    int kept = keptOfSixteen(rows, u, suppress);
    for (int i = u; kept != 0; ++i, kept >>= 1) {
      if ((kept & 1) != 0)
        corners.push_back({static_cast<std::int16_t>(i), static_cast<std::int16_t>(v), rows.here[i], 0.0F});
    }
  }
}

}  // namespace

const std::vector<Corner>& Fast::detect(const ImageView& image, int threshold, Suppression suppression) {
  assert(threshold >= 0 && threshold <= 254);
  assert(image.width <= 32767 && image.height <= 32767);
  corners_.clear();
  if (image.empty() || image.width <= 2 * kRadius || image.height <= 2 * kRadius) return corners_;

  const std::size_t stride = static_cast<std::size_t>(image.width) + 2 * kLanes;
  scores_.assign(3 * stride, 0);
  const auto scores = [&](int v) { return scores_.data() + static_cast<std::size_t>(v % 3) * stride; };
  bool any_here = false;
  for (int v = kRadius; v <= image.height - kRadius; ++v) {
    bool any_below = false;
    if (v < image.height - kRadius) {
      any_below = scoreRow(image, v, threshold, scores(v));
    } else {
      std::memset(scores(v), 0, stride);
    }
    if (any_here) {
      const ScoreRows rows{scores(v + 1), scores(v - 1), scores(v)};
      collectRow(rows, v - 1, image.width, suppression == Suppression::LocalMaximum, corners_);
    }
    any_here = any_below;
  }
  return corners_;
}

}  // namespace urban_nav_core
