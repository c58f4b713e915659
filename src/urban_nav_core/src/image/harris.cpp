// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/harris.hpp"

#include <cassert>
#include <opencv2/core/hal/intrin.hpp>

namespace urban_nav_core {
namespace {

struct Sums {
  int uu, uv, vv;
};

// Sums of products of Sobel responses: each at most 49 * 1020^2, well within 32 bits.
#if CV_SIMD128
using cv::v_int16x8;
using cv::v_int32x4;

/// Filters a row by (1 2 1) and (1 0 -1) in the seven columns of the window; the eighth lane is unused.
struct RowFilters {
  v_int16x8 smooth, slope;
};

inline RowFilters filterRow(const std::uint8_t* p) {  // p: the window's first column; reads p[-1]...p[7]
  const v_int16x8 left = cv::v_reinterpret_as_s16(cv::v_load_expand(p - 1));
  const v_int16x8 here = cv::v_reinterpret_as_s16(cv::v_load_expand(p));
  const v_int16x8 right = cv::v_rotate_right<1>(here);
  return {left + right + (here << 1), right - left};
}

Sums sumProducts(const ImageView& image, int u, int v) {
  const v_int16x8 window(-1, -1, -1, -1, -1, -1, -1, 0);
  const std::uint8_t* p = image.row(v - kHarrisMargin) + u - kHarrisRadius;
  v_int32x4 uu = cv::v_setzero_s32(), uv = uu, vv = uu;
  RowFilters above = filterRow(p), here = filterRow(p + image.stride);
  for (int i = 2; i <= 2 * kHarrisMargin; ++i) {
    const RowFilters below = filterRow(p + i * image.stride);
    const v_int16x8 du = (above.slope + below.slope + (here.slope << 1)) & window;
    const v_int16x8 dv = (below.smooth - above.smooth) & window;
    uu += cv::v_dotprod(du, du);
    uv += cv::v_dotprod(du, dv);
    vv += cv::v_dotprod(dv, dv);
    above = here;
    here = below;
  }
  return {cv::v_reduce_sum(uu), cv::v_reduce_sum(uv), cv::v_reduce_sum(vv)};
}
#else
Sums sumProducts(const ImageView& image, int u, int v) {
  Sums sums{0, 0, 0};
  for (int i = v - kHarrisRadius; i <= v + kHarrisRadius; ++i) {
    for (int k = u - kHarrisRadius; k <= u + kHarrisRadius; ++k) {
      const std::uint8_t *a = image.row(i - 1) + k, *h = image.row(i) + k, *b = image.row(i + 1) + k;
      const int du = a[1] - a[-1] + 2 * (h[1] - h[-1]) + b[1] - b[-1];
      const int dv = b[-1] + 2 * b[0] + b[1] - a[-1] - 2 * a[0] - a[1];
      sums.uu += du * du;
      sums.uv += du * dv;
      sums.vv += dv * dv;
    }
  }
  return sums;
}
#endif

}  // namespace

StructureTensor structureTensor(const ImageView& image, int u, int v) {
  assert(u >= kHarrisMargin && v >= kHarrisMargin && u < image.width - kHarrisMargin &&
         v < image.height - kHarrisMargin);
  constexpr float kPixels = (2 * kHarrisRadius + 1) * (2 * kHarrisRadius + 1);
  constexpr float kSobel = 8.0F;  // the sum of Sobel's weights times the two pixels it spans
  constexpr float kScale = 1.0F / (kPixels * kSobel * kSobel);
  const Sums sums = sumProducts(image, u, v);
  return {static_cast<float>(sums.uu) * kScale, static_cast<float>(sums.uv) * kScale,
          static_cast<float>(sums.vv) * kScale};
}

}  // namespace urban_nav_core
