// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#if defined(__SSE4_1__)
#include <smmintrin.h>
#endif

namespace dense_stereo {

/// Sixteen unsigned bytes, processed by element: the reference for SseBytes, and the implementation for other
/// processors than x86-64. Arithmetic saturates at 0 and 255. All operations are pure.
struct PlainBytes {
  std::array<std::uint8_t, 16> v;

  static PlainBytes load(const std::uint8_t* p) {
    PlainBytes a;
    std::memcpy(a.v.data(), p, 16);
    return a;
  }
  void store(std::uint8_t* p) const { std::memcpy(p, v.data(), 16); }
  static PlainBytes splat(int value) {
    PlainBytes a;
    a.v.fill(static_cast<std::uint8_t>(value));
    return a;
  }
  template <typename Operation>
  static PlainBytes each(const PlainBytes& a, const PlainBytes& b, const Operation& operation) {
    PlainBytes r;
    for (std::size_t i = 0; i < 16; ++i) r.v[i] = static_cast<std::uint8_t>(operation(int{a.v[i]}, int{b.v[i]}));
    return r;
  }
  friend PlainBytes min(const PlainBytes& a, const PlainBytes& b) {
    return each(a, b, [](int x, int y) { return std::min(x, y); });
  }
  friend PlainBytes add(const PlainBytes& a, const PlainBytes& b) {
    return each(a, b, [](int x, int y) { return std::min(x + y, 255); });
  }
  friend PlainBytes subtract(const PlainBytes& a, const PlainBytes& b) {
    return each(a, b, [](int x, int y) { return std::max(x - y, 0); });
  }
  friend PlainBytes exclusiveOr(const PlainBytes& a, const PlainBytes& b) {
    return each(a, b, [](int x, int y) { return x ^ y; });
  }
  friend PlainBytes both(const PlainBytes& a, const PlainBytes& b) {
    return each(a, b, [](int x, int y) { return x & y; });
  }
  friend PlainBytes either(const PlainBytes& a, const PlainBytes& b) {
    return each(a, b, [](int x, int y) { return x | y; });
  }
  /// Returns the mean, rounded up.
  friend PlainBytes average(const PlainBytes& a, const PlainBytes& b) {
    return each(a, b, [](int x, int y) { return (x + y + 1) / 2; });
  }
  friend PlainBytes absoluteDifference(const PlainBytes& a, const PlainBytes& b) {
    return each(a, b, [](int x, int y) { return std::abs(x - y); });
  }
  /// Returns table[index] for indices 0...15.
  friend PlainBytes lookUp(const PlainBytes& table, const PlainBytes& index) {
    PlainBytes r;
    for (std::size_t i = 0; i < 16; ++i) r.v[i] = table.v[index.v[i] & 15];
    return r;
  }
  /// Returns 255 where a == b, else 0.
  friend PlainBytes equal(const PlainBytes& a, const PlainBytes& b) {
    return each(a, b, [](int x, int y) { return x == y ? 255 : 0; });
  }
  /// Returns a where `mask` is 255, b where it is 0.
  friend PlainBytes select(const PlainBytes& mask, const PlainBytes& a, const PlainBytes& b) {
    PlainBytes r;
    for (std::size_t i = 0; i < 16; ++i) r.v[i] = mask.v[i] != 0 ? a.v[i] : b.v[i];
    return r;
  }
  /// Returns the most significant bit of each byte.
  friend unsigned bits(const PlainBytes& a) {
    unsigned r = 0;
    for (unsigned i = 0; i < 16; ++i) r |= static_cast<unsigned>(a.v[i] >> 7) << i;
    return r;
  }
  friend PlainBytes splatLeast(const PlainBytes& a) { return splat(*std::min_element(a.v.begin(), a.v.end())); }
  friend int least(const PlainBytes& a) { return *std::min_element(a.v.begin(), a.v.end()); }
};

#if defined(__SSE4_1__)

/// PlainBytes in an SSE register.
struct SseBytes {
  __m128i v;

  static SseBytes load(const std::uint8_t* p) { return {_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))}; }
  void store(std::uint8_t* p) const { _mm_storeu_si128(reinterpret_cast<__m128i*>(p), v); }
  static SseBytes splat(int value) { return {_mm_set1_epi8(static_cast<char>(value))}; }
  friend SseBytes min(SseBytes a, SseBytes b) { return {_mm_min_epu8(a.v, b.v)}; }
  friend SseBytes add(SseBytes a, SseBytes b) { return {_mm_adds_epu8(a.v, b.v)}; }
  friend SseBytes subtract(SseBytes a, SseBytes b) { return {_mm_subs_epu8(a.v, b.v)}; }
  friend SseBytes exclusiveOr(SseBytes a, SseBytes b) { return {_mm_xor_si128(a.v, b.v)}; }
  friend SseBytes both(SseBytes a, SseBytes b) { return {_mm_and_si128(a.v, b.v)}; }
  friend SseBytes either(SseBytes a, SseBytes b) { return {_mm_or_si128(a.v, b.v)}; }
  friend SseBytes average(SseBytes a, SseBytes b) { return {_mm_avg_epu8(a.v, b.v)}; }
  friend SseBytes absoluteDifference(SseBytes a, SseBytes b) {
    return {_mm_or_si128(_mm_subs_epu8(a.v, b.v), _mm_subs_epu8(b.v, a.v))};
  }
  friend SseBytes lookUp(SseBytes table, SseBytes index) { return {_mm_shuffle_epi8(table.v, index.v)}; }
  friend SseBytes equal(SseBytes a, SseBytes b) { return {_mm_cmpeq_epi8(a.v, b.v)}; }
  friend SseBytes select(SseBytes mask, SseBytes a, SseBytes b) { return {_mm_blendv_epi8(b.v, a.v, mask.v)}; }
  friend unsigned bits(SseBytes a) { return static_cast<unsigned>(_mm_movemask_epi8(a.v)); }
  friend SseBytes splatLeast(SseBytes a) {
    const __m128i words = _mm_min_epu8(a.v, _mm_srli_epi16(a.v, 8));
    const __m128i lowest = _mm_minpos_epu16(_mm_and_si128(words, _mm_set1_epi16(255)));
    return {_mm_shuffle_epi8(lowest, _mm_setzero_si128())};
  }
  friend int least(SseBytes a) {
    const __m128i words = _mm_min_epu8(a.v, _mm_srli_epi16(a.v, 8));
    return _mm_cvtsi128_si32(_mm_minpos_epu16(_mm_and_si128(words, _mm_set1_epi16(255)))) & 0xff;
  }
};

using Bytes = SseBytes;
#else
using Bytes = PlainBytes;
#endif

}  // namespace dense_stereo
