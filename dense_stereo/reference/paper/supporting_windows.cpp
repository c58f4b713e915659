// SPDX-License-Identifier: BSD-3-Clause
#include "paper/supporting_windows.hpp"

#include <algorithm>
#include <cassert>

#include "paper/words.hpp"

namespace dense_stereo {

namespace {

constexpr int kWordLanes = 8;
constexpr std::uint16_t kOutside = 65535;

}  // namespace

template <typename V>
void SupportingWindows<V>::begin(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right, int disparities) {
  assert(disparities % 16 == 0 && left.width() == right.width() && left.height() == right.height());
  left_ = &left;
  right_ = &right;
  if (width_ != left.width() || height_ != left.height() || disparities_ != disparities) {
    width_ = left.width();
    height_ = left.height();
    disparities_ = disparities;
    const std::size_t cells = static_cast<std::size_t>(width_) * static_cast<std::size_t>(disparities);
    reversed_.assign(static_cast<std::size_t>(width_ + disparities), 0);
    columns_.assign(cells, 0);
    windows_.assign(cells * kKeptRows, 0);
    scores_.assign(cells, 0);
    right_cost_.assign(static_cast<std::size_t>(width_), 0);
    right_disparity_ = right_cost_;
  }
  summed_ = scored_ = 0;
  std::fill(columns_.begin(), columns_.end(), std::uint16_t{0});
  for (int v = -kRadius; v <= kRadius; ++v) addRow(v, true);
}

template <typename V>
ScoreRow SupportingWindows<V>::next() {
  for (; summed_ < std::min(scored_ + kRadius + 1, height_); ++summed_) {
    if (summed_ > 0) {
      addRow(summed_ + kRadius, true);
      addRow(summed_ - kRadius - 1, false);
    }
    sumAlong(summed_);
  }
  scoreRow(scored_++);
  findRightWinners();
  return {scores_.data(), right_disparity_.data()};
}

/// Adds the absolute differences of a row to the columns, or subtracts them.
template <typename V>
void SupportingWindows<V>::addRow(int v, bool is_added) {
  const std::uint8_t* left = left_->clampedRow(v);
  const std::uint8_t* right = right_->clampedRow(v);
  for (int u = 0; u < width_; ++u) reversed_[static_cast<std::size_t>(width_ - 1 - u)] = right[u];
  std::fill(reversed_.begin() + width_, reversed_.end(), right[0]);
  for (int u = 0; u < width_; ++u) {
    const std::uint8_t* from = reversed_.data() + (width_ - 1 - u);
    std::uint16_t* column = columns_.data() + static_cast<std::ptrdiff_t>(u) * disparities_;
    for (int d = 0; d < disparities_; d += kWordLanes) {
      const V sum = V::load(column + d), difference = V::differences(left[u], from + d);
      (is_added ? sum + difference : sum - difference).store(column + d);
    }
  }
}

template <typename V>
const std::uint16_t* SupportingWindows<V>::computeSums(int v) const {
  const std::size_t row = static_cast<std::size_t>(std::clamp(v, 0, height_ - 1) % kKeptRows);
  return windows_.data() + row * static_cast<std::size_t>(width_) * static_cast<std::size_t>(disparities_);
}

/// Returns sums over 11 adjacent columns.
template <typename V>
void SupportingWindows<V>::sumAlong(int v) {
  std::uint16_t* sums = const_cast<std::uint16_t*>(computeSums(v));
  const auto column = [this](int u) {
    return columns_.data() + static_cast<std::ptrdiff_t>(std::clamp(u, 0, width_ - 1)) * disparities_;
  };
  for (int d = 0; d < disparities_; d += kWordLanes) {
    V sum = V::splat(0);
    for (int u = -kRadius; u <= kRadius; ++u) sum = sum + V::load(column(u) + d);
    sum.store(sums + d);
  }
  for (int u = 1; u < width_; ++u) {
    const std::uint16_t* added = column(u + kRadius);
    const std::uint16_t* removed = column(u - kRadius - 1);
    std::uint16_t* sum = sums + static_cast<std::ptrdiff_t>(u) * disparities_;
    for (int d = 0; d < disparities_; d += kWordLanes)
      (V::load(sum - disparities_ + d) + V::load(added + d) - V::load(removed + d)).store(sum + d);
  }
}

template <typename V>
void SupportingWindows<V>::scoreRow(int v) {
  const std::uint16_t* rows[3] = {computeSums(v - kRadius), computeSums(v), computeSums(v + kRadius)};
  for (int u = 0; u < width_; ++u) {
    const std::ptrdiff_t before = static_cast<std::ptrdiff_t>(std::max(u - kRadius, 0)) * disparities_;
    const std::ptrdiff_t after = static_cast<std::ptrdiff_t>(std::min(u + kRadius, width_ - 1)) * disparities_;
    const std::ptrdiff_t here = static_cast<std::ptrdiff_t>(u) * disparities_;
    std::uint16_t* score = scores_.data() + here;
    for (int d = 0; d < disparities_; d += kWordLanes) {
      const V a = V::load(rows[0] + before + d), b = V::load(rows[0] + after + d);
      const V c = V::load(rows[2] + before + d), e = V::load(rows[2] + after + d);
      const V low = smaller(a, b), other_low = smaller(c, e);
      const V best = smaller(low, other_low);
      const V second = smaller(larger(low, other_low), smaller(larger(a, b), larger(c, e)));
      (V::load(rows[1] + here + d) + best + second).store(score + d);
    }
    for (int d = u + 1; d < disparities_; ++d) score[d] = kOutside;
  }
}

template <typename V>
void SupportingWindows<V>::findRightWinners() {
  std::fill(right_cost_.begin(), right_cost_.end(), kOutside);
  std::fill(right_disparity_.begin(), right_disparity_.end(), std::uint16_t{0});
  for (int u = 0; u < width_; ++u) {
    const std::uint16_t* score = scores_.data() + static_cast<std::ptrdiff_t>(u) * disparities_;
    const int last = std::min(u, disparities_ - 1);
    for (int d = 0; d <= last; ++d) {
      const std::size_t at = static_cast<std::size_t>(u - d);
      if (score[d] >= right_cost_[at]) continue;
      right_cost_[at] = score[d];
      right_disparity_[at] = static_cast<std::uint16_t>(d);
    }
  }
}

template class SupportingWindows<Words>;
#if defined(__SSE4_1__)
template class SupportingWindows<PlainWords>;
#endif

}  // namespace dense_stereo
