// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#if defined(__SSE4_1__)
#include <smmintrin.h>
#endif

namespace dense_stereo {

/// Four single-precision numbers, processed by element: the reference for SseFloats, and the implementation for other
/// processors than x86-64. Every operation is rounded by IEEE 754, so both are bit-identical.
struct PlainFloats {
  std::array<float, 4> v;

  static PlainFloats load(const float* p) { return {{p[0], p[1], p[2], p[3]}}; }
  void store(float* p) const { std::copy(v.begin(), v.end(), p); }
  static PlainFloats splat(float x) { return {{x, x, x, x}}; }
  template <typename Operation>
  static PlainFloats each(const PlainFloats& a, const PlainFloats& b, const Operation& operation) {
    PlainFloats r{};
    for (std::size_t i = 0; i < 4; ++i) r.v[i] = operation(a.v[i], b.v[i]);
    return r;
  }
  friend PlainFloats operator+(const PlainFloats& a, const PlainFloats& b) {
    return each(a, b, [](float x, float y) { return x + y; });
  }
  friend PlainFloats operator-(const PlainFloats& a, const PlainFloats& b) {
    return each(a, b, [](float x, float y) { return x - y; });
  }
  friend PlainFloats operator*(const PlainFloats& a, const PlainFloats& b) {
    return each(a, b, [](float x, float y) { return x * y; });
  }
  friend PlainFloats operator/(const PlainFloats& a, const PlainFloats& b) {
    return each(a, b, [](float x, float y) { return x / y; });
  }
  friend PlainFloats larger(const PlainFloats& a, const PlainFloats& b) {
    return each(a, b, [](float x, float y) { return x > y ? x : y; });
  }
  friend PlainFloats smaller(const PlainFloats& a, const PlainFloats& b) {
    return each(a, b, [](float x, float y) { return x < y ? x : y; });
  }
  /// Returns a where x < y, else b.
  friend PlainFloats whereLess(const PlainFloats& x, const PlainFloats& y, const PlainFloats& a, const PlainFloats& b) {
    PlainFloats r{};
    for (std::size_t i = 0; i < 4; ++i) r.v[i] = x.v[i] < y.v[i] ? a.v[i] : b.v[i];
    return r;
  }
  friend PlainFloats magnitude(const PlainFloats& a) {
    return each(a, a, [](float x, float) { return std::abs(x); });
  }
  friend float sumLanes(const PlainFloats& a) { return (a.v[0] + a.v[2]) + (a.v[1] + a.v[3]); }
  /// Returns first and second number of the pairs at the integer indices `at`.
  static std::pair<PlainFloats, PlainFloats> gatherPairs(const float* pairs, const PlainFloats& at) {
    std::pair<PlainFloats, PlainFloats> r;
    for (std::size_t i = 0; i < 4; ++i) {
      const float* pair = pairs + 2 * static_cast<int>(at.v[i]);
      r.first.v[i] = pair[0];
      r.second.v[i] = pair[1];
    }
    return r;
  }
};

#if defined(__SSE4_1__)

/// PlainFloats in an SSE register.
struct SseFloats {
  __m128 v;

  static SseFloats load(const float* p) { return {_mm_loadu_ps(p)}; }
  void store(float* p) const { _mm_storeu_ps(p, v); }
  static SseFloats splat(float x) { return {_mm_set1_ps(x)}; }
  friend SseFloats operator+(SseFloats a, SseFloats b) { return {_mm_add_ps(a.v, b.v)}; }
  friend SseFloats operator-(SseFloats a, SseFloats b) { return {_mm_sub_ps(a.v, b.v)}; }
  friend SseFloats operator*(SseFloats a, SseFloats b) { return {_mm_mul_ps(a.v, b.v)}; }
  friend SseFloats operator/(SseFloats a, SseFloats b) { return {_mm_div_ps(a.v, b.v)}; }
  friend SseFloats larger(SseFloats a, SseFloats b) { return {_mm_max_ps(a.v, b.v)}; }
  friend SseFloats smaller(SseFloats a, SseFloats b) { return {_mm_min_ps(a.v, b.v)}; }
  friend SseFloats whereLess(SseFloats x, SseFloats y, SseFloats a, SseFloats b) {
    return {_mm_blendv_ps(b.v, a.v, _mm_cmplt_ps(x.v, y.v))};
  }
  friend SseFloats magnitude(SseFloats a) { return {_mm_andnot_ps(_mm_set1_ps(-0.0F), a.v)}; }
  friend float sumLanes(SseFloats a) {
    const __m128 pairs = _mm_add_ps(a.v, _mm_movehl_ps(a.v, a.v));
    return _mm_cvtss_f32(_mm_add_ss(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
  }
  static std::pair<SseFloats, SseFloats> gatherPairs(const float* pairs, SseFloats at) {
    const __m128i index = _mm_cvttps_epi32(at.v);
    const auto pair = [pairs](int i) { return reinterpret_cast<const __m64*>(pairs + 2 * i); };
    __m128 low = _mm_loadl_pi(_mm_setzero_ps(), pair(_mm_cvtsi128_si32(index)));
    __m128 high = _mm_loadl_pi(_mm_setzero_ps(), pair(_mm_extract_epi32(index, 2)));
    low = _mm_loadh_pi(low, pair(_mm_extract_epi32(index, 1)));
    high = _mm_loadh_pi(high, pair(_mm_extract_epi32(index, 3)));
    return {{_mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0))}, {_mm_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1))}};
  }
};

using Floats = SseFloats;
#else
using Floats = PlainFloats;
#endif

}  // namespace dense_stereo
