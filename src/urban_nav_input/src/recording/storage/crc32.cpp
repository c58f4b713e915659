// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/crc32.hpp"

#include <zlib.h>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace urban_nav_input {

#if defined(__x86_64__)

namespace {

constexpr std::size_t kLane = 16, kBlock = 4 * kLane;  // bytes

/// Powers of x modulo the polynomial, bit-reflected, which shift 128 bits over the following data (Gopal et al. 2009,
/// "Fast CRC computation for generic polynomials using PCLMULQDQ instruction").
constexpr long long kOverBlock[] = {0x154442bd4, 0x1c6e41596}, kOverLane[] = {0x1751997d0, 0x0ccaa009e},
                    kOver64 = 0x163cd6124, kPolynomial = 0x1db710641, kBarrett = 0x1f7011641;

__attribute__((target("pclmul,sse4.1"))) __m128i load(const std::uint8_t* bytes) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
}

__attribute__((target("pclmul,sse4.1"))) __m128i fold(__m128i sum, __m128i powers, __m128i next) {
  const __m128i low = _mm_clmulepi64_si128(sum, powers, 0x00), high = _mm_clmulepi64_si128(sum, powers, 0x11);
  return _mm_xor_si128(_mm_xor_si128(low, high), next);
}

/// Requires at least one block, and complete lanes. `state`: the CRC without its final inversion.
__attribute__((target("pclmul,sse4.1"))) std::uint32_t foldLanes(const std::uint8_t* at, std::size_t size,
                                                                 std::uint32_t state) {
  const __m128i over_block = _mm_set_epi64x(kOverBlock[1], kOverBlock[0]);
  const __m128i over_lane = _mm_set_epi64x(kOverLane[1], kOverLane[0]);
  __m128i sums[4];
  for (std::size_t i = 0; i < 4; ++i) sums[i] = load(at + i * kLane);
  sums[0] = _mm_xor_si128(sums[0], _mm_cvtsi32_si128(static_cast<int>(state)));
  at += kBlock, size -= kBlock;
  for (; size >= kBlock; at += kBlock, size -= kBlock)
    for (std::size_t i = 0; i < 4; ++i) sums[i] = fold(sums[i], over_block, load(at + i * kLane));
  __m128i sum = sums[0];
  for (std::size_t i = 1; i < 4; ++i) sum = fold(sum, over_lane, sums[i]);
  for (; size >= kLane; at += kLane, size -= kLane) sum = fold(sum, over_lane, load(at));
  // Reduces 128 bits to 64, and these to 32 by Barrett reduction.
  const __m128i low32 = _mm_setr_epi32(-1, 0, -1, 0);
  sum = _mm_xor_si128(_mm_srli_si128(sum, 8), _mm_clmulepi64_si128(sum, over_lane, 0x10));
  sum = _mm_xor_si128(_mm_srli_si128(sum, 4),
                      _mm_clmulepi64_si128(_mm_and_si128(sum, low32), _mm_set_epi64x(0, kOver64), 0x00));
  const __m128i barrett = _mm_set_epi64x(kBarrett, kPolynomial);
  const __m128i quotient = _mm_and_si128(_mm_clmulepi64_si128(_mm_and_si128(sum, low32), barrett, 0x10), low32);
  return static_cast<std::uint32_t>(
      _mm_extract_epi32(_mm_xor_si128(sum, _mm_clmulepi64_si128(quotient, barrett, 0x00)), 1));
}

}  // namespace

std::uint32_t crc32(ByteView bytes, std::uint32_t before) {
  static const bool has_multiplication = __builtin_cpu_supports("pclmul") != 0 && __builtin_cpu_supports("sse4.1") != 0;
  if (has_multiplication && bytes.size >= kBlock) {
    const std::size_t lanes = bytes.size - bytes.size % kLane;
    before = ~foldLanes(bytes.data, lanes, ~before);
    bytes = {bytes.data + lanes, bytes.size - lanes};
  }
  return bytes.size == 0 ? before : static_cast<std::uint32_t>(::crc32_z(before, bytes.data, bytes.size));
}

#else

std::uint32_t crc32(ByteView bytes, std::uint32_t before) {
  return bytes.size == 0 ? before : static_cast<std::uint32_t>(::crc32_z(before, bytes.data, bytes.size));
}

#endif

}  // namespace urban_nav_input
