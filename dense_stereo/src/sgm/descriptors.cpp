// SPDX-License-Identifier: BSD-3-Clause
#include "sgm/descriptors.hpp"

#include <cstring>

#include "sgm/bytes.hpp"

namespace dense_stereo {

namespace {

constexpr int kReach = 3;  // rows and columns of the window to each side
constexpr int kRows = 2 * kReach + 1;
constexpr std::ptrdiff_t kMargin = 32;  // bytes before and after a row of descriptors

struct Comparison {
  int du, dv, other_du, other_dv;
};

constexpr std::array<Comparison, DescriptorRow::kBits> listComparisons() {
  std::array<Comparison, DescriptorRow::kBits> list{};
  std::size_t n = 0;
  for (int dv = -kReach; dv <= 0; ++dv)
    for (int du = -kReach; du <= kReach && (dv < 0 || du < 0); ++du) list[n++] = {du, dv, -du, -dv};
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du)
      if (du != 0 || dv != 0) list[n++] = {du, dv, 0, 0};
  return list;
}
constexpr std::array<Comparison, DescriptorRow::kBits> kComparisons = listComparisons();

template <typename V>
V reversed(V bytes) {
  alignas(16) static constexpr std::uint8_t kOrder[16] = {15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
  return lookUp(bytes, V::load(kOrder));
}

}  // namespace

void DescriptorRow::resize(int width, int disparities) {
  const std::size_t stride = static_cast<std::size_t>(width + disparities) + 2 * static_cast<std::size_t>(kMargin);
  if (memory_.size() == stride * (kNibbleCount + 1)) return;
  memory_.assign(stride * (kNibbleCount + 1), 0);
  std::uint8_t* at = memory_.data() + kMargin;
  for (std::uint8_t*& nibble : nibbles) {
    nibble = at;
    at += stride;
  }
  gradient = at;
}

template <typename V>
void describeRow(const Padded<std::uint8_t>& image, int v, PixelOrder order, DescriptorRow& row) {
  std::array<const std::uint8_t*, kRows> lines{};
  for (int i = 0; i < kRows; ++i) lines[static_cast<std::size_t>(i)] = image.clampedRow(v + i - kReach);
  const auto pixels = [&lines](int u, int du, int dv) {
    return V::load(lines[static_cast<std::size_t>(kReach + dv)] + u + du);
  };
  const auto column = [&](int u) { return average(average(pixels(u, 0, -1), pixels(u, 0, 1)), pixels(u, 0, 0)); };
  const V zero = V::splat(0), all = V::splat(255);
  const auto put = [&](std::uint8_t* out, int u, V value) {
    if (order == PixelOrder::Forward) value.store(out + u);
    else reversed(value).store(out + image.width() - 16 - u);
  };
  for (int u = 0; u < image.width(); u += 16) {
    std::size_t next = 0;
    for (std::uint8_t* nibble : row.nibbles) {
      V value = zero;
      for (int bit = 1; bit < 16; bit *= 2) {
        const Comparison& c = kComparisons[next++];
        const V is_less = equal(subtract(pixels(u, c.du, c.dv), pixels(u, c.other_du, c.other_dv)), zero);
        value = either(value, both(is_less, V::splat(bit)));
      }
      put(nibble, u, value);
    }
    put(row.gradient, u, average(column(u + 1), exclusiveOr(column(u - 1), all)));
  }
}

void extendRows(Padded<std::uint8_t>& image) {
  for (int v = 0; v < image.height(); ++v) {
    std::uint8_t* row = image.row(v);
    std::memset(row - image.kPadding, row[0], static_cast<std::size_t>(image.kPadding));
    std::memset(row + image.width(), row[image.width() - 1], static_cast<std::size_t>(image.kPadding));
  }
}

template void describeRow<Bytes>(const Padded<std::uint8_t>&, int, PixelOrder, DescriptorRow&);
#if defined(__SSE4_1__)
template void describeRow<PlainBytes>(const Padded<std::uint8_t>&, int, PixelOrder, DescriptorRow&);
#endif

}  // namespace dense_stereo
