// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/image/pyramid.hpp"

#include <cassert>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

namespace urban_nav_core {
namespace {

constexpr int kRowMargin = 16;  // elements of the row buffer before the first column

int mirrored(int i, int n) {
  if (n == 1) return 0;
  const int period = 2 * (n - 1);
  i = ((i % period) + period) % period;
  return i < n ? i : period - i;
}

/// Filters the columns of five rows by 1 4 6 4 1: at most 4080. Writes up to 15 elements beyond `width`.
void smoothDown(const std::uint8_t* const rows[5], int width, std::int16_t* out) {
  int u = 0;
#if CV_SIMD128
  using cv::v_uint16x8;
  for (; u < width; u += 16) {
    v_uint16x8 a[5], b[5];
    for (int k = 0; k < 5; ++k) cv::v_expand(cv::v_load(rows[k] + u), a[k], b[k]);
    const v_uint16x8 low = a[0] + a[4] + ((a[1] + a[2] + a[3]) << 2) + (a[2] << 1);
    const v_uint16x8 high = b[0] + b[4] + ((b[1] + b[2] + b[3]) << 2) + (b[2] << 1);
    cv::v_store(out + u, cv::v_reinterpret_as_s16(low));
    cv::v_store(out + u + 8, cv::v_reinterpret_as_s16(high));
  }
#else
  for (; u < width; ++u) {
    out[u] = static_cast<std::int16_t>(rows[0][u] + rows[4][u] + 4 * (rows[1][u] + rows[3][u]) + 6 * rows[2][u]);
  }
#endif
}

/// Filters a row by 1 4 6 4 1 at its even elements and divides by 256. `row` has two mirrored elements on either side;
/// up to 15 bytes beyond `width` of `out` may be overwritten.
void smoothAcross(const std::int16_t* row, int width, std::uint8_t* out) {
  int u = 0;
#if CV_SIMD128
  using cv::v_int16x8;
  using cv::v_int32x4;
  const v_int16x8 before(1, 4, 1, 4, 1, 4, 1, 4), here(6, 4, 6, 4, 6, 4, 6, 4), after(1, 0, 1, 0, 1, 0, 1, 0);
  const v_int32x4 half = cv::v_setall_s32(128);
  const auto four = [&](const std::int16_t* p) {
    return (cv::v_dotprod(cv::v_load(p - 2), before) + cv::v_dotprod(cv::v_load(p), here) +
            cv::v_dotprod(cv::v_load(p + 2), after) + half) >>
           8;
  };
  for (; u < width; u += 16) {
    const std::int16_t* p = row + 2 * u;
    const v_int16x8 low = cv::v_pack(four(p), four(p + 8));
    const v_int16x8 high = cv::v_pack(four(p + 16), four(p + 24));
    cv::v_store(out + u, cv::v_pack_u(low, high));
  }
#else
  for (; u < width; ++u) {
    const std::int16_t* p = row + 2 * u;
    out[u] = static_cast<std::uint8_t>((p[-2] + p[2] + 4 * (p[-1] + p[1]) + 6 * p[0] + 128) >> 8);
  }
#endif
}

}  // namespace

Pyramid::Pyramid(int levels) : wanted_(levels) {
  assert(levels >= 1 && levels <= 16);
  views_.resize(static_cast<std::size_t>(levels));
}

Pyramid::Pyramid(int levels, int width, int height) : Pyramid(levels) { resize(width, height); }

void Pyramid::resize(int width, int height) {
  layout_.clear();
  std::size_t end = kPadding;
  for (int l = 0; l < wanted_; ++l) {
    if (l > 0 && (width < kSmallestSide || height < kSmallestSide)) break;
    const std::ptrdiff_t stride = (width + kPadding + 31) / 32 * 32;
    layout_.push_back({width, height, stride, end});
    end += static_cast<std::size_t>(stride * height) + kPadding;
    width = (width + 1) / 2;
    height = (height + 1) / 2;
  }
  pixels_.assign(end, 0);
  row_.assign(static_cast<std::size_t>(layout_.front().width) + 2 * kRowMargin + 64, 0);
}

void Pyramid::build(const ImageView& image) {
  filled_ = 0;
  if (image.empty()) return;
  if (layout_.empty() || layout_.front().width != image.width || layout_.front().height != image.height) {
    resize(image.width, image.height);
  }
  for (const Level& level : layout_) {
    std::uint8_t* out = pixels_.data() + level.offset;
    if (filled_ == 0) {
      for (int v = 0; v < level.height; ++v) {
        std::memcpy(out + v * level.stride, image.row(v), static_cast<std::size_t>(level.width));
      }
    } else {
      const ImageView& below = views_[static_cast<std::size_t>(filled_ - 1)];
      std::int16_t* row = row_.data() + kRowMargin;
      for (int v = 0; v < level.height; ++v) {
        const std::uint8_t* rows[5];
        for (int k = 0; k < 5; ++k) rows[k] = below.row(mirrored(2 * v + k - 2, below.height));
        smoothDown(rows, below.width, row);
        for (int k = 1; k <= 2; ++k) {
          row[-k] = row[mirrored(-k, below.width)];
          row[below.width - 1 + k] = row[mirrored(below.width - 1 + k, below.width)];
        }
        smoothAcross(row, level.width, out + v * level.stride);
      }
    }
    views_[static_cast<std::size_t>(filled_++)] = {out, level.width, level.height, level.stride};
  }
}

}  // namespace urban_nav_core
