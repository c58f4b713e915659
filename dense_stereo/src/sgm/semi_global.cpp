// SPDX-License-Identifier: BSD-3-Clause
#include "sgm/semi_global.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <cstring>

#include "sgm/bytes.hpp"

namespace dense_stereo {

namespace {

constexpr int kLanes = 16;
constexpr std::uint8_t kInfinite = 255;  // cost of disparities outside the range

alignas(16) constexpr std::uint8_t kOnesInNibble[kLanes] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
alignas(16) constexpr std::uint8_t kCounting[kLanes] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/// State of a path at the previous pixel: its costs with `kInfinite` on both sides, their minimum, and P2.
template <typename V>
struct PathStep {
  const std::uint8_t* before;
  V least, with_jump, step;
  V run = V::splat(kInfinite);

  PathStep(const std::uint8_t* costs, int least_cost, int jump, int step_penalty)
      : before(costs),
        least(V::splat(least_cost)),
        with_jump(V::splat(std::min(least_cost + jump, 255))),
        step(V::splat(step_penalty)) {}

  /// Returns the path costs of sixteen disparities at this pixel (Hirschmueller 2008, eq. 13), minus the previous
  /// minimum.
  V extend(int d, V cost) {
    const V stay = V::load(before + d), move = add(min(V::load(before + d - 1), V::load(before + d + 1)), step);
    const V result = add(subtract(min(min(stay, move), with_jump), least), cost);
    run = min(run, result);
    return result;
  }
};

unsigned firstBit(unsigned bits) { return static_cast<unsigned>(__builtin_ctz(bits)); }

}  // namespace

template <typename V>
void SemiGlobal<V>::resize(int width, int height, int disparities) {
  assert(width > 0 && height > 0 && disparities >= 16 && disparities <= 512 && disparities % 16 == 0);
  if (width == width_ && height == height_ && disparities == disparities_) return;
  width_ = width;
  height_ = height;
  disparities_ = disparities;
  const std::size_t cells = static_cast<std::size_t>(width) * static_cast<std::size_t>(disparities);
  const std::size_t padded =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(disparities + kLanes) + 2 * kLanes;
  left_row_.resize(width, disparities);
  right_row_.resize(width, disparities);
  costs_.assign(cells, 0);
  sums_.assign(cells, 0);
  above_.assign(padded, kInfinite);
  above_least_.assign(static_cast<std::size_t>(width), 0);
  for (auto& pixel : along_) pixel.assign(static_cast<std::size_t>(disparities + 2 * kLanes), kInfinite);
  right_cost_.assign(static_cast<std::size_t>(width + disparities), 0);
  right_disparity_ = right_cost_;
  right_high_ = right_cost_;
  around_.assign(static_cast<std::size_t>(2 * disparities + 2 * kLanes), 0);
  for (int i = -1; i <= 1; ++i) around_[static_cast<std::size_t>(disparities + kLanes + i)] = 255;
}

template <typename V>
void SemiGlobal<V>::match(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right,
                          const Penalties& penalties, Winners& winners) {
  assert(left.width() == width_ && left.height() == height_ && right.width() == width_ && right.height() == height_);
  penalties_ = penalties;
  for (int i = 0; i < 256; ++i)
    jumps_[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::max(penalties.least_jump, penalties.jump - i * penalties.jump_slope));
  winners.disparity.resize(width_, height_);
  winners.cost.resize(width_, height_);
  winners.rival.resize(width_, height_);
  const std::size_t stride = static_cast<std::size_t>(disparities_ + kLanes);
  for (std::size_t u = 0; u < static_cast<std::size_t>(width_); ++u)
    std::memset(above_.data() + kLanes + u * stride, 0, static_cast<std::size_t>(disparities_));
  std::fill(above_least_.begin(), above_least_.end(), std::uint8_t{0});
  switch (disparities_) {  // common sizes have loops of constant length
    case 64: return matchRows<4, false>(left, right, winners);
    case 128: return matchRows<8, false>(left, right, winners);
    default:
      if (disparities_ > 256) return matchRows<0, true>(left, right, winners);
      return matchRows<0, false>(left, right, winners);
  }
}

template <typename V>
template <int blocks, bool is_wide>
void SemiGlobal<V>::matchRows(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right, Winners& winners) {
  for (int v = 0; v < height_; ++v) {
    describeRow<V>(left, v, PixelOrder::Forward, left_row_);
    describeRow<V>(right, v, PixelOrder::Backward, right_row_);
    sweepRight<blocks>(left.row(v), left.clampedRow(v - 1));
    sweepLeft<blocks, is_wide>(left.row(v), winners.disparity.row(v), winners.cost.row(v), winners.rival.row(v));
    checkAgainstRight(winners.disparity.row(v));
  }
}

template <typename V>
template <int blocks>
void SemiGlobal<V>::sweepRight(const std::uint8_t* pixels, const std::uint8_t* pixels_above) {
  const int disparities = blocks > 0 ? kLanes * blocks : disparities_;
  const V ones = V::load(kOnesInNibble), limit = V::splat(penalties_.gradient_limit);
  const auto worst = static_cast<std::uint8_t>(DescriptorRow::kBits + penalties_.gradient_limit);
  std::uint8_t* before = along_[0].data() + kLanes;
  std::uint8_t* now = along_[1].data() + kLanes;
  std::memset(before, 0, static_cast<std::size_t>(disparities));
  int least_before = 0;
  for (int u = 0; u < width_; ++u) {
    const int shift = width_ - 1 - u;  // of the right image's row, which is reversed: disparity 0
    std::uint8_t* costs = costs_.data() + static_cast<std::ptrdiff_t>(u) * disparities;
    const V gradient = V::splat(left_row_.gradient[u]);
    V nibbles[DescriptorRow::kNibbleCount];
    for (std::size_t k = 0; k < DescriptorRow::kNibbleCount; ++k) nibbles[k] = V::splat(left_row_.nibbles[k][u]);
    for (int d = 0; d < disparities; d += kLanes) {
      V cost = min(absoluteDifference(gradient, V::load(right_row_.gradient + shift + d)), limit);
      for (std::size_t k = 0; k < DescriptorRow::kNibbleCount; ++k)
        cost = add(cost, lookUp(ones, exclusiveOr(nibbles[k], V::load(right_row_.nibbles[k] + shift + d))));
      cost.store(costs + d);
    }
    if (u + 1 < disparities) std::memset(costs + u + 1, worst, static_cast<std::size_t>(disparities - u - 1));

    std::uint8_t* above = above_.data() + kLanes + static_cast<std::ptrdiff_t>(u) * (disparities + kLanes);
    std::uint8_t* sums = sums_.data() + static_cast<std::ptrdiff_t>(u) * disparities;
    std::uint8_t& least_above = above_least_[static_cast<std::size_t>(u)];
    const int jump_along = jumps_[static_cast<std::size_t>(std::abs(pixels[u] - pixels[u > 0 ? u - 1 : 0]))];
    const int jump_down = jumps_[static_cast<std::size_t>(std::abs(pixels[u] - pixels_above[u]))];
    PathStep<V> along(before, least_before, jump_along, penalties_.step);
    PathStep<V> down(above, least_above, jump_down, penalties_.step);
    V pending = V::splat(0);  // of the previous block: stored late, since this block reads the last byte that it
                              // replaces
    for (int d = 0; d < disparities; d += kLanes) {
      const V cost = V::load(costs + d);
      const V from_left = along.extend(d, cost), from_above = down.extend(d, cost);
      from_left.store(now + d);
      add(from_left, from_above).store(sums + d);
      if (d > 0) pending.store(above + d - kLanes);
      pending = from_above;
    }
    pending.store(above + disparities - kLanes);
    least_before = least(along.run);
    least_above = static_cast<std::uint8_t>(least(down.run));
    std::swap(before, now);
  }
}

template <typename V>
template <int blocks, bool is_wide>
void SemiGlobal<V>::sweepLeft(const std::uint8_t* pixels, std::uint16_t* disparity, std::uint8_t* cost,
                              std::uint8_t* rival) {
  const int disparities = blocks > 0 ? kLanes * blocks : disparities_;
  std::uint8_t* before = along_[0].data() + kLanes;
  std::uint8_t* now = along_[1].data() + kLanes;
  std::memset(before, 0, static_cast<std::size_t>(disparities));
  std::fill(right_cost_.begin(), right_cost_.end(), kInfinite);
  int least_before = 0;
  for (int u = width_ - 1; u >= 0; --u) {
    const std::uint8_t* costs = costs_.data() + static_cast<std::ptrdiff_t>(u) * disparities;
    std::uint8_t* sums = sums_.data() + static_cast<std::ptrdiff_t>(u) * disparities;
    const int jump = jumps_[static_cast<std::size_t>(std::abs(pixels[u] - pixels[u + 1 < width_ ? u + 1 : u]))];
    PathStep<V> along(before, least_before, jump, penalties_.step);
    std::uint8_t* right_cost = right_cost_.data() + (width_ - 1 - u);
    std::uint8_t* right_disparity = right_disparity_.data() + (width_ - 1 - u);
    [[maybe_unused]] std::uint8_t* right_high = right_high_.data() + (width_ - 1 - u);
    V best = V::splat(kInfinite);
    for (int d = 0; d < disparities; d += kLanes) {
      const V from_right = along.extend(d, V::load(costs + d));
      from_right.store(now + d);
      const V sum = add(V::load(sums + d), from_right);
      sum.store(sums + d);
      best = min(best, sum);
      const V right_best = min(V::load(right_cost + d), sum);
      right_best.store(right_cost + d);
      const V is_best = equal(right_best, sum), here = add(V::load(kCounting), V::splat(d & 255));
      select(is_best, here, V::load(right_disparity + d)).store(right_disparity + d);
      if constexpr (is_wide) select(is_best, V::splat(d / 256), V::load(right_high + d)).store(right_high + d);
    }
    least_before = least(along.run);
    std::swap(before, now);

    best = splatLeast(best);
    int winner = 0;
    for (int d = 0; d < disparities; d += kLanes) {
      const unsigned found = bits(equal(V::load(sums + d), best));
      if (found == 0) continue;
      winner = d + static_cast<int>(firstBit(found));
      break;
    }
    const std::uint8_t* around = around_.data() + disparities + kLanes - winner;
    V second = V::splat(kInfinite);
    for (int d = 0; d < disparities; d += kLanes) second = min(second, either(V::load(around + d), V::load(sums + d)));
    disparity[u] = static_cast<std::uint16_t>(winner);
    cost[u] = static_cast<std::uint8_t>(least(best));
    rival[u] = static_cast<std::uint8_t>(least(second));
  }
}

template <typename V>
void SemiGlobal<V>::checkAgainstRight(std::uint16_t* disparity) const {
  const bool is_wide = disparities_ > 256;
  for (int u = 0; u < width_; ++u) {
    const int d = disparity[u];
    const std::size_t right = static_cast<std::size_t>(width_ - 1 - u + d);
    if (d > u || std::abs(right_disparity_[right] + (is_wide ? 256 * right_high_[right] : 0) - d) > 2)
      disparity[u] = Winners::kInvalid;
  }
}

template class SemiGlobal<Bytes>;
#if defined(__SSE4_1__)
template class SemiGlobal<PlainBytes>;
#endif

}  // namespace dense_stereo
