// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>

#if defined(__SSE4_1__)
#include <smmintrin.h>
#endif

namespace dense_stereo {

/// Eight unsigned 16-bit numbers, processed by element: the reference for SseWords, and the implementation for other
/// processors than x86-64. Sums wrap around.
struct PlainWords {
  std::array<std::uint16_t, 8> v;

  static PlainWords load(const std::uint16_t* p) {
    PlainWords a;
    std::memcpy(a.v.data(), p, sizeof a.v);
    return a;
  }
  void store(std::uint16_t* p) const { std::memcpy(p, v.data(), sizeof v); }
  static PlainWords splat(int value) {
    PlainWords a;
    a.v.fill(static_cast<std::uint16_t>(value));
    return a;
  }
  /// Returns |value - p[i]| of bytes.
  static PlainWords differences(std::uint8_t value, const std::uint8_t* p) {
    PlainWords a;
    for (std::size_t i = 0; i < 8; ++i) a.v[i] = static_cast<std::uint16_t>(std::abs(value - p[i]));
    return a;
  }
  template <typename Operation>
  static PlainWords each(const PlainWords& a, const PlainWords& b, const Operation& operation) {
    PlainWords r;
    for (std::size_t i = 0; i < 8; ++i) r.v[i] = static_cast<std::uint16_t>(operation(int{a.v[i]}, int{b.v[i]}));
    return r;
  }
  friend PlainWords operator+(const PlainWords& a, const PlainWords& b) {
    return each(a, b, [](int x, int y) { return x + y; });
  }
  friend PlainWords operator-(const PlainWords& a, const PlainWords& b) {
    return each(a, b, [](int x, int y) { return x - y; });
  }
  friend PlainWords smaller(const PlainWords& a, const PlainWords& b) {
    return each(a, b, [](int x, int y) { return std::min(x, y); });
  }
  friend PlainWords larger(const PlainWords& a, const PlainWords& b) {
    return each(a, b, [](int x, int y) { return std::max(x, y); });
  }
  /// Returns the first minimum: value, then position.
  friend std::pair<int, int> findLeast(const PlainWords& a) {
    const auto at = std::min_element(a.v.begin(), a.v.end());
    return {*at, static_cast<int>(at - a.v.begin())};
  }
};

#if defined(__SSE4_1__)

/// PlainWords in an SSE register.
struct SseWords {
  __m128i v;

  static SseWords load(const std::uint16_t* p) { return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))}; }
  void store(std::uint16_t* p) const { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), v); }
  static SseWords splat(int value) { return {_mm_set1_epi16(static_cast<std::int16_t>(value))}; }
  static SseWords differences(std::uint8_t value, const std::uint8_t* p) {
    const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
    return {_mm_abs_epi16(_mm_sub_epi16(_mm_set1_epi16(value), _mm_cvtepu8_epi16(bytes)))};
  }
  friend SseWords operator+(SseWords a, SseWords b) { return {_mm_add_epi16(a.v, b.v)}; }
  friend SseWords operator-(SseWords a, SseWords b) { return {_mm_sub_epi16(a.v, b.v)}; }
  friend SseWords smaller(SseWords a, SseWords b) { return {_mm_min_epu16(a.v, b.v)}; }
  friend SseWords larger(SseWords a, SseWords b) { return {_mm_max_epu16(a.v, b.v)}; }
  friend std::pair<int, int> findLeast(SseWords a) {
    const int packed = _mm_cvtsi128_si32(_mm_minpos_epu16(a.v));
    return {packed & 0xffff, (packed >> 16) & 7};
  }
};

using Words = SseWords;
#else
using Words = PlainWords;
#endif

}  // namespace dense_stereo
