// SPDX-License-Identifier: BSD-3-Clause
#include "refine/slanted_alignment.hpp"

#include <algorithm>
#include <cmath>

#include "refine/floats.hpp"
#include "refine/plane_fit.hpp"

namespace dense_stereo {

namespace {

constexpr float kSlopePrior = 0.05F;
constexpr float kTiny = 1e-6F;
constexpr float kPriorWeight = 1.0F / (0.5F * 0.5F);  // px^-2: error of the integer disparities
constexpr float kLeastNoise = 1.0F;                   // grey levels^2
constexpr float kLongestStep = 1.0F;                  // px; the linearisation is invalid beyond it
// Largest difference from the centre's disparity of pixels of the same surface, near a depth edge.
constexpr float kSameSurface = 1.3F;
constexpr int kEdgeRadius = 3;

/// Binomial filter 1 2 1 along a row, which removes frequencies for which the derivative is inaccurate.
void smoothRow(const std::uint8_t* pixels, int width, float gain, float offset, float* out) {
  const float quarter = 0.25F * gain;
  constexpr int kMargin = 16;
  for (int u = -kMargin; u < width + kMargin; ++u)
    out[u] = quarter * static_cast<float>(pixels[u - 1] + 2 * pixels[u] + pixels[u + 1]) + offset;
}

/// Fourth-order derivative: central differences are a fifth too small at wavelengths of six pixels, which makes steps
/// too long by the same factor.
float slopeAt(const float* row, int u) {
  return (8.0F * (row[u + 1] - row[u - 1]) - (row[u + 2] - row[u - 2])) * (1.0F / 12.0F);
}

template <typename V>
struct Moments {
  V sum, first, second;
};

/// Returns sums over -4...4 with weights 1, k, k^2 of elements `stride` apart.
template <typename V, typename At>
[[gnu::always_inline]] inline Moments<V> computeMoments(const At& at) {
  V sum = at(0), first = V::splat(0.0F), second = V::splat(0.0F);
#pragma GCC unroll 5
  for (int k = 1; k <= 4; ++k) {
    const V after = at(k), before = at(-k), both = after + before;
    sum = sum + both;
    first = first + V::splat(static_cast<float>(k)) * (after - before);
    second = second + V::splat(static_cast<float>(k * k)) * both;
  }
  return {sum, first, second};
}

/// Returns sums over -4.5, -3.5 ... 4.5 with weights 1, k - 0.5, (k - 0.5)^2; at(k) is the element at k - 0.5.
template <typename V, typename At>
[[gnu::always_inline]] inline Moments<V> momentsDown(const At& at) {
  V sum = V::splat(0.0F), first = sum, second = sum;
#pragma GCC unroll 5
  for (int k = 0; k <= 4; ++k) {
    const V below = at(k + 1), above = at(-k), both = below + above;
    const float distance = static_cast<float>(k) + 0.5F;
    sum = sum + both;
    first = first + V::splat(distance) * (below - above);
    second = second + V::splat(distance * distance) * both;
  }
  return {sum, first, second};
}

template <typename V, typename At>
[[gnu::always_inline]] inline V sumDown(const At& at) {
  V sum = at(0) + at(1);
#pragma GCC unroll 5
  for (int k = 1; k <= 4; ++k) sum = sum + (at(k + 1) + at(-k));
  return sum;
}

template <typename V, typename At>
[[gnu::always_inline]] inline V sumAround(const At& at) {
  V sum = at(0);
#pragma GCC unroll 5
  for (int k = 1; k <= 4; ++k) sum = sum + (at(k) + at(-k));
  return sum;
}

}  // namespace

template <typename V>
void SlantedAlignment<V>::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  stride_ = static_cast<std::size_t>(width + 2 * Padded<float>::kPadding);
  ring_.assign(stride_ * channels * kRows, 0.0F);
  left_.assign(stride_, 0.0F);
  left_slope_.assign(stride_, 0.0F);
  right_.assign(stride_, 0.0F);
  right_pairs_.assign(2 * stride_, 0.0F);
}

template <typename V>
void SlantedAlignment<V>::step(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right,
                               const Exposure& exposure, const Padded<std::uint8_t>& edges, const Padded<float>& start,
                               DisparityField& result) {
  result.disparity.resize(width_, height_, DisparityField::kInvalid);
  result.noise.resize(width_, height_);
  result.information.resize(width_, height_);
  for (int v = 0; v < kRows; ++v) clearRow(v);
  constexpr int kAhead = kRadius + 1;
  for (int v = 0; v < height_ + kAhead; ++v) {
    if (v < height_) {
      measureRow(left.row(v), right.row(v), exposure, start.row(v), v);
      sumRow(v);
    } else {
      clearRow(v);
    }
    const int first = v - kAhead;
    if (first < 0 || first % 2 != 0) continue;
    solveRows(first, start, result);
    solveEdges(first, edges, start, result);
  }
}

template <typename V>
void SlantedAlignment<V>::clearRow(int v) {
  float* row = channel(v, G) - Padded<float>::kPadding;
  std::fill(row, row + stride_ * channels, 0.0F);
}

template <typename V>
typename SlantedAlignment<V>::Lines SlantedAlignment<V>::linesAround(int v) {
  Lines lines{};
  for (int k = -kRadius; k <= kRadius + 1; ++k)
    lines[static_cast<std::size_t>(k + kRadius)] = channel(v + k + kRows, G) - Padded<float>::kPadding;
  return lines;
}

template <typename V>
void SlantedAlignment<V>::measureRow(const std::uint8_t* left, const std::uint8_t* right, const Exposure& exposure,
                                     const float* start, int v) {
  float* const l = left_.data() + Padded<float>::kPadding;
  float* const l_slope = left_slope_.data() + Padded<float>::kPadding;
  float* const r = right_.data() + Padded<float>::kPadding;
  float* const r_pairs = right_pairs_.data() + 2 * Padded<float>::kPadding;
  smoothRow(left, width_, 1.0F, 0.0F, l);
  smoothRow(right, width_, exposure.gain, exposure.offset, r);
  for (int u = 0; u < width_; ++u) l_slope[u] = slopeAt(l, u);
  for (int u = -4; u < width_; ++u) {
    r_pairs[2 * u] = r[u];
    r_pairs[2 * u + 1] = slopeAt(r, u);
  }
  alignas(16) static constexpr float kLane[4] = {0.0F, 1.0F, 2.0F, 3.0F};
  const V zero = V::splat(0.0F), half = V::splat(0.5F), one = V::splat(1.0F);
  for (int u = 0; u < width_; u += 4) {
    const V d = V::load(start + u);
    const V valid = whereLess(d, zero, zero, one);
    const V at = larger(V::load(kLane) + V::splat(static_cast<float>(u)) - larger(d, zero), zero);
    const auto [value_right, slope_right] =
        V::gatherPairs(r_pairs, smaller(at, V::splat(static_cast<float>(width_ - 1))));
    const V difference = value_right - V::load(l + u);
    const V slope = half * (slope_right + V::load(l_slope + u));
    const V gradient = valid * slope, value = gradient * d + valid * difference;
    gradient.store(channel(v, G) + u);
    (gradient * gradient).store(channel(v, GG) + u);
    value.store(channel(v, Q) + u);
    (gradient * value).store(channel(v, GQ) + u);
    (valid * difference).store(channel(v, Difference) + u);
    (valid * difference * difference).store(channel(v, Square) + u);
    valid.store(channel(v, Valid) + u);
  }
  for (Channel c : {G, GG, Q, GQ, Difference, Square, Valid})  // the last vector may extend beyond the end
    std::fill(channel(v, c) + width_, channel(v, c) + width_ + 2 * kRadius, 0.0F);
}

template <typename V>
void SlantedAlignment<V>::sumRow(int v) {
  for (int u = 0; u < width_; u += 4) {
    const auto along = [u](const float* row) { return [row, u](int k) { return V::load(row + u + k); }; };
    const Moments<V> gg = computeMoments<V>(along(channel(v, GG)));
    gg.sum.store(channel(v, SumGG) + u);
    gg.first.store(channel(v, SumGGU) + u);
    gg.second.store(channel(v, SumGGUU) + u);
    const Moments<V> g = computeMoments<V>(along(channel(v, G))), gq = computeMoments<V>(along(channel(v, GQ)));
    g.sum.store(channel(v, SumG) + u);
    g.first.store(channel(v, SumGU) + u);
    gq.sum.store(channel(v, SumGQ) + u);
    gq.first.store(channel(v, SumGQU) + u);
    sumAround<V>(along(channel(v, Q))).store(channel(v, SumQ) + u);
    sumAround<V>(along(channel(v, Difference))).store(channel(v, Differences) + u);
    sumAround<V>(along(channel(v, Square))).store(channel(v, Squares) + u);
    sumAround<V>(along(channel(v, Valid))).store(channel(v, Count) + u);
  }
}

template <typename V>
void SlantedAlignment<V>::solveRows(int v, const Padded<float>& start, DisparityField& result) {
  const Lines lines = linesAround(v);
  const V invalid = V::splat(DisparityField::kInvalid), zero = V::splat(0.0F), half = V::splat(0.5F);
  const int last = std::min(v + 1, height_ - 1);
  for (int u = 0; u < width_; u += 4) {
    const auto down = [&lines, this, u](Channel c) {
      const std::size_t at = c * stride_ + static_cast<std::size_t>(u + Padded<float>::kPadding);
      return [&lines, at](int k) { return V::load(lines[static_cast<std::size_t>(k + kRadius)] + at); };
    };
    const V count = larger(sumDown<V>(down(Count)), V::splat(1.0F));
    const V mean = sumDown<V>(down(Differences)) / count;
    const V noise = larger(sumDown<V>(down(Squares)) / count - mean * mean, zero);
    const Moments<V> gg = momentsDown<V>(down(SumGG)), ggu = momentsDown<V>(down(SumGGU)),
                     g = momentsDown<V>(down(SumG)), gq = momentsDown<V>(down(SumGQ));
    const PlaneSums<V> sums{gg.sum,    ggu.sum,
                            gg.first,  sumDown<V>(down(SumGGUU)),
                            ggu.first, gg.second,
                            g.sum,     sumDown<V>(down(SumGU)),
                            g.first,   count,
                            gq.sum,    sumDown<V>(down(SumGQU)),
                            gq.first,  sumDown<V>(down(SumQ))};
    const V weight = V::splat(kPriorWeight) * (noise + V::splat(kLeastNoise));
    const V above = V::load(start.row(v) + u), below = V::load(start.row(last) + u);
    const V prior = whereLess(above, zero, below, whereLess(below, zero, above, half * (above + below)));
    const PlaneFit<V> fit = fitPlane(sums, prior, weight, V::splat(kSlopePrior), V::splat(kTiny));
    for (int k = v; k <= last; ++k) {
      const V before = k == v ? above : below;
      const V step = half * fit.slope_v;
      const V moved = larger(k == v ? fit.disparity - step : fit.disparity + step, zero);
      const V ok = whereLess(magnitude(moved - before), V::splat(kLongestStep), moved, before);
      whereLess(before, zero, invalid, ok).store(result.disparity.row(k) + u);
      noise.store(result.noise.row(k) + u);
      fit.information.store(result.information.row(k) + u);
    }
  }
}

/// Pixels of a block of 2x2 on one surface share a plane.
template <typename V>
void SlantedAlignment<V>::solveEdges(int v, const Padded<std::uint8_t>& edges, const Padded<float>& start,
                                     DisparityField& result) {
  const Lines lines = linesAround(v);
  const int last = std::min(v + 1, height_ - 1);
  for (int u = 0; u < width_; u += 2) {
    bool pending[4];
    for (int i = 0; i < 4; ++i) {
      const int pu = u + i % 2, pv = v + i / 2;
      pending[i] = pu < width_ && pv <= last && edges.row(pv)[pu] != 0 && start.row(pv)[pu] >= 0.0F;
    }
    for (int i = 0; i < 4; ++i) {
      if (!pending[i]) continue;
      const float disparity = start.row(v + i / 2)[u + i % 2];
      const PlaneAtEdge fit = fitAtEdge(lines, u, v, disparity, start);
      for (int k = i; k < 4; ++k) {
        const int pu = u + k % 2, pv = v + k / 2;
        if (!pending[k] || std::abs(start.row(pv)[pu] - disparity) >= kSameSurface) continue;
        pending[k] = false;
        const float before = start.row(pv)[pu];
        const float moved = larger(fit.plane.disparity + (static_cast<float>(k % 2) - 0.5F) * fit.plane.slope_u +
                                       (static_cast<float>(k / 2) - 0.5F) * fit.plane.slope_v,
                                   0.0F);
        result.disparity.row(pv)[pu] = std::abs(moved - before) < kLongestStep ? moved : before;
        result.noise.row(pv)[pu] = fit.noise;
        result.information.row(pv)[pu] = fit.plane.information;
      }
    }
  }
}

/// Fits the plane to the pixels of a window of 8x8 whose disparities are close to `disparity`; (u, v) is left of and
/// above its centre.
template <typename V>
typename SlantedAlignment<V>::PlaneAtEdge SlantedAlignment<V>::fitAtEdge(const Lines& lines, int u, int v,
                                                                         float disparity,
                                                                         const Padded<float>& start) const {
  const V zero = V::splat(0.0F), one = V::splat(1.0F), here = V::splat(disparity), near = V::splat(kSameSurface);
  alignas(16) static constexpr float kColumns[8] = {-3.5F, -2.5F, -1.5F, -0.5F, 0.5F, 1.5F, 2.5F, 3.5F};
  PlaneSums<V> s{zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
  V squares = zero, differences = zero;
  for (int k = std::max(-kEdgeRadius, -v); k <= std::min(kEdgeRadius + 1, height_ - 1 - v); ++k) {
    const float* const line = lines[static_cast<std::size_t>(k + kRadius)];
    const V dv = V::splat(static_cast<float>(k) - 0.5F);
    for (int part = 0; part < 8; part += 4) {
      const int at = u - kEdgeRadius + part;
      const V mask = whereLess(magnitude(V::load(start.row(v + k) + at) - here), near, one, zero);
      const V du = V::load(kColumns + part);
      const auto pixel = [&](Channel c) {
        return mask * V::load(line + c * stride_ + static_cast<std::size_t>(at + Padded<float>::kPadding));
      };
      const V g = pixel(G), gg = pixel(GG), gq = pixel(GQ), ggu = gg * du, ggv = gg * dv;
      s = {s.gg + gg,         s.ggu + ggu,     s.ggv + ggv,     s.gguu + ggu * du, s.gguv + ggu * dv,
           s.ggvv + ggv * dv, s.g + g,         s.gu + g * du,   s.gv + g * dv,     s.count + mask,
           s.gq + gq,         s.gqu + gq * du, s.gqv + gq * dv, s.q + pixel(Q)};
      squares = squares + pixel(Square);
      differences = differences + pixel(Difference);
    }
  }
  const float count = larger(sumLanes(s.count), 1.0F), mean = sumLanes(differences) / count;
  const float noise = larger(sumLanes(squares) / count - mean * mean, 0.0F);
  const PlaneSums<float> sums{sumLanes(s.gg),   sumLanes(s.ggu), sumLanes(s.ggv), sumLanes(s.gguu), sumLanes(s.gguv),
                              sumLanes(s.ggvv), sumLanes(s.g),   sumLanes(s.gu),  sumLanes(s.gv),   count,
                              sumLanes(s.gq),   sumLanes(s.gqu), sumLanes(s.gqv), sumLanes(s.q)};
  return {fitPlane(sums, disparity, kPriorWeight * (noise + kLeastNoise), kSlopePrior, kTiny), noise};
}

template class SlantedAlignment<Floats>;
#if defined(__SSE4_1__)
template class SlantedAlignment<PlainFloats>;
#endif

}  // namespace dense_stereo
