// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/fast.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

#include "fast_score.hpp"

namespace urban_nav_core {
namespace {

constexpr int kLanes = 16;

/// Scores of three successive rows.
struct ScoreRows {
  const std::uint8_t* above;
  const std::uint8_t* here;
  const std::uint8_t* below;
};

#if CV_SIMD128
using cv::v_uint8x16;

/// Returns a mask: bit i is set if the score of pixel i is positive and, if requested, a local maximum.
inline int keptOfSixteen(const ScoreRows& rows, int u, bool suppress) {
  const v_uint8x16 zero = cv::v_setzero_u8();
  const v_uint8x16 score = cv::v_load(rows.here + u);
  if (!cv::v_check_any(score != zero)) return 0;
  if (!suppress) return cv::v_signmask(score != zero);
  const v_uint8x16 before = cv::v_max(cv::v_max(cv::v_load(rows.above + u - 1), cv::v_load(rows.above + u)),
                                      cv::v_max(cv::v_load(rows.above + u + 1), cv::v_load(rows.here + u - 1)));
  const v_uint8x16 after = cv::v_max(cv::v_max(cv::v_load(rows.below + u - 1), cv::v_load(rows.below + u)),
                                     cv::v_max(cv::v_load(rows.below + u + 1), cv::v_load(rows.here + u + 1)));
  return cv::v_signmask(((score - before) != zero) & ((after - score) == zero));
}
#else
int keptOfSixteen(const ScoreRows& rows, int first, bool suppress) {
  int bits = 0;
  for (int i = 0; i < kLanes; ++i) {
    const int u = first + i;
    const int score = rows.here[u];
    const int before = std::max({rows.above[u - 1], rows.above[u], rows.above[u + 1], rows.here[u - 1]});
    const int after = std::max({rows.below[u - 1], rows.below[u], rows.below[u + 1], rows.here[u + 1]});
    if (score != 0 && (!suppress || (score > before && score >= after))) bits |= 1 << i;
  }
  return bits;
}
#endif

void collectRow(const ScoreRows& rows, int v, int width, bool suppress, std::vector<Corner>& corners) {
  for (int u = Fast::kRadius; u < width - Fast::kRadius; u += kLanes) {
    int kept = keptOfSixteen(rows, u, suppress);
    for (int i = u; kept != 0; ++i, kept >>= 1) {
      if ((kept & 1) != 0)
        corners.push_back({static_cast<std::int16_t>(i), static_cast<std::int16_t>(v), rows.here[i]});
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
  static const fast_score::InstructionSet set = fast_score::instructionSets().front();
  const auto scores = [&](int v) { return scores_.data() + static_cast<std::size_t>(v % 3) * stride; };
  bool any_here = false;
  for (int v = kRadius; v <= image.height - kRadius; ++v) {
    bool any_below = false;
    if (v < image.height - kRadius) {
      any_below = set.scoreRow(image.row(v), image.stride, kRadius, image.width - kRadius, threshold, scores(v));
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
