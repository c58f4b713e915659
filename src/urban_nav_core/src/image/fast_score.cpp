// SPDX-License-Identifier: BSD-3-Clause
#include "fast_score.hpp"

#include <algorithm>
#include <cstring>

#if defined(__x86_64__)
#define URBAN_NAV_X86 1
#endif

// Vectors wider than those of the baseline are passed only between inlined functions, so no call depends on the ABI.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace urban_nav_core::fast_score {
namespace {

constexpr int kCircle = 16;
// Bresenham's circle of radius 3 from the bottom, counter-clockwise (Rosten and Drummond 2006, figure 1).
constexpr int kCircleU[kCircle] = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
constexpr int kCircleV[kCircle] = {3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1, 0, 1, 2, 3};

// GCC vector types, so that one source serves every width.
struct Narrow {
  typedef std::uint8_t Vector __attribute__((vector_size(16)));
  static constexpr int kLanes = 16;
};
struct Middle {
  typedef std::uint8_t Vector __attribute__((vector_size(32)));
  static constexpr int kLanes = 32;
};

#define URBAN_NAV_INLINE __attribute__((always_inline)) inline

template <typename V>
URBAN_NAV_INLINE V least(const V& a, const V& b) {
  return a < b ? a : b;
}
template <typename V>
URBAN_NAV_INLINE V most(const V& a, const V& b) {
  return a > b ? a : b;
}
template <typename V>
URBAN_NAV_INLINE V excess(const V& a, const V& b) {
  return most(a, b) - b;
}
template <typename V>
URBAN_NAV_INLINE V load(const std::uint8_t* p) {
  V v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

/// Minimum and maximum, exchanged for dark arcs: the smallest maximum is computed like the largest minimum.
template <bool dark, typename V>
URBAN_NAV_INLINE V lower(const V& a, const V& b) {
  return dark ? most(a, b) : least(a, b);
}
template <bool dark, typename V>
URBAN_NAV_INLINE V upper(const V& a, const V& b) {
  return dark ? least(a, b) : most(a, b);
}

/// Returns the largest grey level that nine contiguous pixels of the circle all reach: max over arcs of min over the
/// arc (dark: min of max). Arcs that begin at k - 1 and at k, k odd, share eight pixels, so eight minima of eight
/// pixels are sufficient for sixteen arcs.
template <bool dark, typename V>
URBAN_NAV_INLINE V bestArc(const V* p) {
  V pair[8], quad[8];
#pragma GCC unroll 16
  for (int i = 0; i < 8; ++i) pair[i] = lower<dark>(p[2 * i + 1], p[(2 * i + 2) % kCircle]);
#pragma GCC unroll 16
  for (int i = 0; i < 8; ++i) quad[i] = lower<dark>(pair[i], pair[(i + 1) % 8]);
  V best = lower<dark>(lower<dark>(quad[0], quad[2]), upper<dark>(p[0], p[9]));
#pragma GCC unroll 16
  for (int i = 1; i < 8; ++i)
    best = upper<dark>(
        best, lower<dark>(lower<dark>(quad[i], quad[(i + 2) % 8]), upper<dark>(p[2 * i], p[(2 * i + 9) % kCircle])));
  return best;
}

/// Saturated differences: the extrema of the arcs are compared with the centre, not every pixel.
template <typename V>
URBAN_NAV_INLINE V computeScore(const V* circle, const V& centre, const V& threshold) {
  const V score = most(excess(bestArc<false>(circle), centre), excess(centre, bestArc<true>(circle)));
  return score > threshold ? score : V{};
}

/// Necessary conditions: nine contiguous pixels of the circle include four consecutive even positions, among them two
/// adjacent compass points. `even`: pixels at the even positions; the first test uses every other one.
template <bool dark, typename V>
URBAN_NAV_INLINE V twoOfTheCompass(const V* even) {
  return lower<dark>(upper<dark>(even[0], even[4]), upper<dark>(even[2], even[6]));
}
template <bool dark, typename V>
URBAN_NAV_INLINE V fourInARow(const V* even) {
  V pair[8];
#pragma GCC unroll 16
  for (int i = 0; i < 8; ++i) pair[i] = lower<dark>(even[i], even[(i + 1) % 8]);
  V best = lower<dark>(pair[0], pair[2]);
#pragma GCC unroll 16
  for (int i = 1; i < 8; ++i) best = upper<dark>(best, lower<dark>(pair[i], pair[(i + 2) % 8]));
  return best;
}

template <typename V>
URBAN_NAV_INLINE bool any(const V& v) {
  std::uint64_t words[sizeof(V) / 8];
  std::memcpy(words, &v, sizeof v);
  std::uint64_t all = 0;
  for (const std::uint64_t word : words) all |= word;
  return all != 0;
}

/// Few pixels, mostly isolated, pass the test of the even positions: they are gathered from their row and scored
/// together.
template <typename Width>
struct Gathered {
  using V = typename Width::Vector;
  alignas(32) std::uint8_t circle[kCircle][Width::kLanes];
  alignas(32) std::uint8_t centre[Width::kLanes];
  int at[Width::kLanes];
  int count = 0;
};

template <typename Width>
URBAN_NAV_INLINE bool scoreGathered(Gathered<Width>& some, const typename Width::Vector& threshold,
                                    std::uint8_t* scores) {
  using V = typename Width::Vector;
  V circle[kCircle];
#pragma GCC unroll 16
  for (int i = 0; i < kCircle; ++i) circle[i] = load<V>(some.circle[i]);
  const V score = computeScore<V>(circle, load<V>(some.centre), threshold);
  for (int i = 0; i < some.count; ++i) scores[some.at[i]] = score[i];
  some.count = 0;
  return any(score);
}

template <typename Width>
URBAN_NAV_INLINE bool scoreRowAs(const std::uint8_t* row, std::ptrdiff_t stride, int begin, int end, int threshold,
                                 std::uint8_t* scores) {
  using V = typename Width::Vector;
  constexpr int kLanes = Width::kLanes;
  std::ptrdiff_t offsets[kCircle];
#pragma GCC unroll 16
  for (int i = 0; i < kCircle; ++i) offsets[i] = kCircleV[i] * stride + kCircleU[i];
  const std::uint8_t t = static_cast<std::uint8_t>(threshold), room = static_cast<std::uint8_t>(255 - threshold);
  V limit = V{} + t;
  std::memset(scores + begin, 0, static_cast<std::size_t>(end - begin));
  Gathered<Width> some{};
  bool found = false;
  const auto gather = [&](int u) __attribute__((always_inline)) {
    const std::uint8_t* pixel = row + u;
#pragma GCC unroll 16
    for (int i = 0; i < kCircle; ++i) some.circle[i][some.count] = pixel[offsets[i]];
    some.centre[some.count] = *pixel;
    some.at[some.count] = u;
    if (++some.count == kLanes) found |= scoreGathered<Width>(some, limit, scores);
  };
  for (int u = begin; u < end; u += kLanes) {
    if (u + kLanes > end) {
      if (end - begin < kLanes) {
        for (; u < end; ++u) gather(u);
        break;
      }
      u = end - kLanes;  // processes some pixels twice instead of reading beyond the row
    }
    const std::uint8_t* pixel = row + u;
    const V centre = load<V>(pixel);
    const V above = least(centre, V{} + room) + t, below = excess(centre, limit);
    V even[8];
#pragma GCC unroll 16
    for (int i = 0; i < 8; i += 2) even[i] = load<V>(pixel + offsets[2 * i]);
    if (!any(most(excess(twoOfTheCompass<false>(even), above), excess(below, twoOfTheCompass<true>(even))))) continue;
#pragma GCC unroll 16
    for (int i = 1; i < 8; i += 2) even[i] = load<V>(pixel + offsets[2 * i]);
    const V rest = most(excess(fourInARow<false>(even), above), excess(below, fourInARow<true>(even)));
    const V candidates = reinterpret_cast<V>(rest > V{});
    std::uint64_t words[kLanes / 8];
    std::memcpy(words, &candidates, sizeof candidates);
    for (int w = 0; w < kLanes / 8; ++w)
      for (std::uint64_t bits = words[w] & 0x8080808080808080ULL; bits != 0; bits &= bits - 1)
        gather(u + 8 * w + __builtin_ctzll(bits) / 8);
  }
  if (some.count > 0) found |= scoreGathered<Width>(some, limit, scores);
  return found;
}

bool scoreRowNarrow(const std::uint8_t* row, std::ptrdiff_t stride, int begin, int end, int threshold,
                    std::uint8_t* scores) {
  return scoreRowAs<Narrow>(row, stride, begin, end, threshold, scores);
}
#ifdef URBAN_NAV_X86
__attribute__((target("avx2"))) bool scoreRowMiddle(const std::uint8_t* row, std::ptrdiff_t stride, int begin, int end,
                                                    int threshold, std::uint8_t* scores) {
  return scoreRowAs<Middle>(row, stride, begin, end, threshold, scores);
}
#endif

}  // namespace

std::vector<InstructionSet> instructionSets() {
  std::vector<InstructionSet> sets;
#ifdef URBAN_NAV_X86
  if (__builtin_cpu_supports("avx2") != 0) sets.push_back({"avx2", scoreRowMiddle});
#endif
  sets.push_back({"baseline", scoreRowNarrow});
  return sets;
}

}  // namespace urban_nav_core::fast_score
