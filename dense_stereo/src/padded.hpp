// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dense_stereo {

/// Image with `kPadding` writable elements before and after every row, so that vector loops need no tails. Row-major.
/// resize() allocates only when the size changes.
template <typename T>
class Padded {
 public:
  static constexpr std::ptrdiff_t kPadding = 32;

  void resize(int width, int height, T value = T{}) {
    if (width == width_ && height == height_) return;
    width_ = width;
    height_ = height;
    stride_ = width + 2 * kPadding;
    data_.assign(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height), value);
  }
  void fill(T value) { std::fill(data_.begin(), data_.end(), value); }

  int width() const { return width_; }
  int height() const { return height_; }
  T* row(int v) { return data_.data() + v * stride_ + kPadding; }
  const T* row(int v) const { return data_.data() + v * stride_ + kPadding; }
  /// Returns row v, clamped to the image.
  const T* clampedRow(int v) const { return row(std::clamp(v, 0, height_ - 1)); }

 private:
  int width_ = 0, height_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<T> data_;
};

}  // namespace dense_stereo
