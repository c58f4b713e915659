// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// An image and its halved copies. Each level is the one below, smoothed by the binomial (1 4 6 4 1)/16 in both
/// directions and taken at its even pixels: the filter is centred on a pixel, so with integers as pixel centres
///
///   u_level = u / 2^level,  v_level = v / 2^level   exactly.
///
/// A level has (n + 1) / 2 columns and rows where the one below has n. Outside the image the filter sees it mirrored
/// about the border pixels (a b c | b a). Sums are rounded to nearest, once per level.
///
/// All levels, level 0 included, are copies: they live until the next build() and owe nothing to the input. Before the
/// first and after the last byte of a level, and so around every row, at least kPadding bytes may be read (of
/// unspecified value), which spares SIMD loops their tails. Not thread-safe; allocates only when the size changes.
class Pyramid {
 public:
  static constexpr int kPadding = 32;
  static constexpr int kSmallestSide = 16;  ///< px; smaller levels are not made

  /// `levels` >= 1 are asked for; small images have fewer. Memory is taken by the first build().
  explicit Pyramid(int levels);
  /// Takes the memory for images of this size now.
  Pyramid(int levels, int width, int height);
  Pyramid(Pyramid&&) noexcept = default;
  Pyramid& operator=(Pyramid&&) noexcept = default;
  Pyramid(const Pyramid&) = delete;  // the views would look into the other's pixels
  Pyramid& operator=(const Pyramid&) = delete;

  /// An empty view leaves the pyramid empty (levels() == 0).
  void build(const ImageView& image);

  int levels() const { return filled_; }
  const ImageView& level(int l) const { return views_[static_cast<std::size_t>(l)]; }
  /// Pixels of this level per pixel of level 0: 2^-l.
  static double scale(int l) { return 1.0 / static_cast<double>(1 << l); }

 private:
  struct Level {
    int width = 0, height = 0;
    std::ptrdiff_t stride = 0;
    std::size_t offset = 0;
  };

  void resize(int width, int height);

  int wanted_;
  int filled_ = 0;
  std::vector<Level> layout_;
  std::vector<ImageView> views_;
  std::vector<std::uint8_t> pixels_;
  std::vector<std::int16_t> row_;
};

}  // namespace urban_nav_core
