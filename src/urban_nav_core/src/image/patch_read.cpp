// SPDX-License-Identifier: BSD-3-Clause
#include "patch_read.hpp"

#include <cstring>
#include <opencv2/core/hal/intrin.hpp>

#include "vectors.hpp"

namespace urban_nav_core::patch_read {
namespace {

using vectors::load;
using vectors::store;

// One source serves every width.
struct Narrow {
  typedef float Floats __attribute__((vector_size(16)));
  static constexpr int kLanes = 4;
};
struct Middle {
  typedef float Floats __attribute__((vector_size(32)));
  static constexpr int kLanes = 8;
};

constexpr int kLine = 12, kWide = 16, kPadded = 24;

/// Convolves with six taps at distance `apart`; with four if there is no blur.
template <typename V>
URBAN_NAV_INLINE V filtered(const float* p, int apart, const float* w, bool blurs) {
  V value = w[1] * load<V>(p + apart) + w[2] * load<V>(p + 2 * apart) +
            (w[3] * load<V>(p + 3 * apart) + w[4] * load<V>(p + 4 * apart));
  if (blurs) value += w[0] * load<V>(p) + w[5] * load<V>(p + 5 * apart);
  return value;
}

template <typename Width>
URBAN_NAV_INLINE void readAs(const std::uint8_t* first, std::ptrdiff_t stride, const float* wx, const float* wy,
                             bool blurs, float* window) {
  using V = typename Width::Floats;
  constexpr int kLanes = Width::kLanes, kLines = kRows + kTaps - 1;
  alignas(32) float pixels[kLines * kWide];
  for (int i = 0; i < kLines; ++i) {
    cv::v_uint16x8 half[2];
    cv::v_expand(cv::v_load(first + i * stride), half[0], half[1]);
#pragma GCC unroll 2
    for (int k = 0; k < 2; ++k) {
      cv::v_uint32x4 low, high;
      cv::v_expand(half[k], low, high);
      cv::v_store_aligned(pixels + i * kWide + 8 * k, cv::v_cvt_f32(cv::v_reinterpret_as_s32(low)));
      cv::v_store_aligned(pixels + i * kWide + 8 * k + 4, cv::v_cvt_f32(cv::v_reinterpret_as_s32(high)));
    }
  }
  alignas(32) float column[kRows * kPadded];  // values beyond 16 are multiplied by padding only
  for (int i = 0; i < kRows; ++i) {
#pragma GCC unroll 4
    for (int k = 0; k < kWide; k += kLanes)
      store(column + i * kPadded + k, filtered<V>(pixels + i * kWide + k, kWide, wy, blurs));
#pragma GCC unroll 2
    for (int k = kWide; k < kPadded; k += kLanes) store(column + i * kPadded + k, V{});
  }
  for (int i = 0; i < kRows; ++i) {
    const float* from = column + i * kPadded;
    float* to = window + i * kLine;
    int k = 0;
#pragma GCC unroll 3
    for (; k + kLanes <= kLine; k += kLanes) store(to + k, filtered<V>(from + k, 1, wx, blurs));
    if (kLanes > 4) store(to + k, filtered<Narrow::Floats>(from + k, 1, wx, blurs));
  }
}

/// Eight partial sums, independent of the vector width.
template <typename Width>
struct Eight {
  typename Width::Floats part[8 / Width::kLanes];
};

template <typename Width>
URBAN_NAV_INLINE float total(const Eight<Width>& sum) {
  float each[8];
  std::memcpy(each, &sum, sizeof each);
  return ((each[0] + each[4]) + (each[2] + each[6])) + ((each[1] + each[5]) + (each[3] + each[7]));
}

template <typename Width>
URBAN_NAV_INLINE Sums measureAs(const float* window, const float* weight, const float* fx, const float* fy,
                                const float* fg) {
  using V = typename Width::Floats;
  constexpr int kLanes = Width::kLanes, kCount = kRows * kLine;
  Eight<Width> x{}, y{}, g{}, m{}, q{};
  for (int i = 0; i + 8 <= kCount; i += 8)
#pragma GCC unroll 2
    for (int k = 0; k < 8 / kLanes; ++k) {
      const int at = i + k * kLanes;
      const V p = load<V>(window + at), weighted = p * load<V>(weight + at);
      x.part[k] += p * load<V>(fx + at);
      y.part[k] += p * load<V>(fy + at);
      g.part[k] += p * load<V>(fg + at);
      m.part[k] += weighted;
      q.part[k] += weighted * p;
    }
  Sums sums{total<Width>(x), total<Width>(y), total<Width>(g), total<Width>(m), total<Width>(q)};
  for (int i = kCount / 8 * 8; i < kCount - 1; ++i) {  // the last element is padding
    const float p = window[i], weighted = p * weight[i];
    sums.along_x += p * fx[i];
    sums.along_y += p * fy[i];
    sums.gain += p * fg[i];
    sums.mean += weighted;
    sums.square += weighted * p;
  }
  return sums;
}

// One function of each kind per width: the target processor is an attribute of the function.
#define URBAN_NAV_KERNELS(Width, target)                                                                      \
  target void read##Width(const std::uint8_t* first, std::ptrdiff_t stride, const float* wx, const float* wy, \
                          bool blurs, float* window) {                                                        \
    if (blurs) readAs<Width>(first, stride, wx, wy, true, window);                                            \
    else readAs<Width>(first, stride, wx, wy, false, window);                                                 \
  }                                                                                                           \
  target Sums measure##Width(const float* window, const float* weight, const float* fx, const float* fy,      \
                             const float* fg) {                                                               \
    return measureAs<Width>(window, weight, fx, fy, fg);                                                      \
  }

URBAN_NAV_KERNELS(Narrow, )
#ifdef URBAN_NAV_X86
URBAN_NAV_KERNELS(Middle, __attribute__((target("avx2"))))
#endif

}  // namespace

std::vector<InstructionSet> instructionSets() {
  std::vector<InstructionSet> sets;
#ifdef URBAN_NAV_X86
  if (__builtin_cpu_supports("avx2") != 0) sets.push_back({"avx2", readMiddle, measureMiddle});
#endif
  sets.push_back({"baseline", readNarrow, measureNarrow});
  return sets;
}

const InstructionSet& fastest() {
  static const InstructionSet set = instructionSets().front();
  return set;
}

}  // namespace urban_nav_core::patch_read
