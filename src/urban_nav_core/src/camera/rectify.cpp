// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/rectify.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

namespace urban_nav_core {
namespace {

constexpr int kFractionBits = 7;
constexpr int kOne = 1 << kFractionBits;

#if CV_SIMD128
using cv::v_int16x8;
using cv::v_uint16x8;

/// Loads bytes u and u + 1 at eight offsets as the low and high halves of eight lanes.
inline v_uint16x8 pairs(const std::uint8_t* data, const int* offsets) {
  std::uint16_t lanes[8];
  for (int i = 0; i < 8; ++i) std::memcpy(&lanes[i], data + offsets[i], 2);
  return cv::v_load(lanes);
}

/// Interpolates along the row. At most 255 * 128, which fits signed lanes.
inline v_int16x8 across(const v_uint16x8& pair, const v_int16x8& du) {
  const v_int16x8 left = cv::v_reinterpret_as_s16(pair & cv::v_setall_u16(255));
  const v_int16x8 right = cv::v_reinterpret_as_s16(pair >> 8);
  return (left << kFractionBits) + cv::v_mul_wrap(right - left, du);
}
#endif

}  // namespace

RectifyMap::RectifyMap(const RawCamera& raw, const Eigen::Matrix3d& R_rectified_raw, const Pinhole& rectified)
    : raw_(raw), R_raw_rectified_(R_rectified_raw.transpose()), rectified_(rectified) {
  assert(raw.pinhole.width >= 2 && raw.pinhole.height >= 2 && raw.pinhole.width <= 32767 &&
         raw.pinhole.height <= 32767);
  const std::size_t size = static_cast<std::size_t>(rectified.width) * static_cast<std::size_t>(rectified.height);
  table_.resize(size);
  covered_.resize(size);
  const double last_u = raw.pinhole.width - 1, last_v = raw.pinhole.height - 1;
  std::size_t covered = 0;
  for (int v = 0; v < rectified.height; ++v) {
    for (int u = 0; u < rectified.width; ++u) {
      const std::optional<Eigen::Vector2d> seen = rawPixel({static_cast<double>(u), static_cast<double>(v)});
      const Eigen::Vector2d p = seen.value_or(Eigen::Vector2d(-1.0, -1.0));
      const bool inside = p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= last_u && p.y() <= last_v;
      const double x = std::clamp(p.x(), 0.0, last_u), y = std::clamp(p.y(), 0.0, last_v);
      const int left = std::min(static_cast<int>(x), raw.pinhole.width - 2);
      const int top = std::min(static_cast<int>(y), raw.pinhole.height - 2);
      table_[index(u, v)] = {static_cast<std::int16_t>(left), static_cast<std::int16_t>(top),
                             static_cast<std::int16_t>(std::lround((x - left) * kOne)),
                             static_cast<std::int16_t>(std::lround((y - top) * kOne))};
      covered_[index(u, v)] = inside ? 1 : 0;
      covered += inside ? 1 : 0;
    }
  }
  covered_share_ = size > 0 ? static_cast<double>(covered) / static_cast<double>(size) : 0.0;
}

std::optional<Eigen::Vector2d> RectifyMap::rawPixel(const Eigen::Vector2d& pixel) const {
  return raw_.project(R_raw_rectified_ * rectified_.ray(pixel));
}

ImageView RectifyMap::remap(const ImageView& raw, std::vector<std::uint8_t>& out) const {
  if (raw.empty() || raw.width != raw_.pinhole.width || raw.height != raw_.pinhole.height) return {};
  out.resize(table_.size());
  const int stride = static_cast<int>(raw.stride);
  std::size_t i = 0;
#if CV_SIMD128
  static_assert(sizeof(Entry) == 8, "four planes of 16 bits, interleaved");
  const cv::v_int32x4 half = cv::v_setall_s32(1 << (2 * kFractionBits - 1));
  const v_int16x8 one = cv::v_setall_s16(kOne);
  for (; i + 8 <= table_.size(); i += 8) {
    v_int16x8 u, v, du, dv;
    cv::v_load_deinterleave(&table_[i].u, u, v, du, dv);
    int offsets[8];
    for (std::size_t k = 0; k < 8; ++k) offsets[k] = table_[i + k].v * stride + table_[i + k].u;
    const v_int16x8 top = across(pairs(raw.data, offsets), du);
    const v_int16x8 bottom = across(pairs(raw.data + raw.stride, offsets), du);
    v_int16x8 rows_low, rows_high, weights_low, weights_high;
    cv::v_zip(top, bottom, rows_low, rows_high);
    cv::v_zip(one - dv, dv, weights_low, weights_high);
    const cv::v_int32x4 low = (cv::v_dotprod(rows_low, weights_low) + half) >> (2 * kFractionBits);
    const cv::v_int32x4 high = (cv::v_dotprod(rows_high, weights_high) + half) >> (2 * kFractionBits);
    cv::v_pack_u_store(out.data() + i, cv::v_pack(low, high));
  }
#endif
  for (; i < table_.size(); ++i) {
    const Entry& entry = table_[i];
    const std::uint8_t* p = raw.data + entry.v * raw.stride + entry.u;
    const std::uint8_t* q = p + raw.stride;
    const int top = p[0] * kOne + (p[1] - p[0]) * entry.du;
    const int bottom = q[0] * kOne + (q[1] - q[0]) * entry.du;
    out[i] = static_cast<std::uint8_t>((top * (kOne - entry.dv) + bottom * entry.dv + (1 << (2 * kFractionBits - 1))) >>
                                       (2 * kFractionBits));
  }
  return {out.data(), rectified_.width, rectified_.height, rectified_.width};
}

}  // namespace urban_nav_core
