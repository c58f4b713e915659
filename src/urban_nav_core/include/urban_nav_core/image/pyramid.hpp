// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Image pyramid. Each level is the previous one, smoothed by the binomial (1 4 6 4 1)/16 in both directions and
/// sampled at its even pixels. The filter is centred on a pixel, so with integers as pixel centres
///
///   u_level = u / 2^level,  v_level = v / 2^level   exactly.
///
/// A level has (n + 1) / 2 columns and rows where the previous one has n. The image is mirrored about the border pixels
/// (a b c | b a). Sums are rounded to nearest, once per level.
///
/// All levels, including level 0, are copies, valid until the next build(). At least kPadding bytes (of unspecified
/// value) may be read before the first and after the last byte of a level, and so around every row, which spares SIMD
/// loops their tails. Not thread-safe; allocates only when the size changes.
class Pyramid {
 public:
  static constexpr int kPadding = 32;
  static constexpr int kSmallestSide = 16;  ///< px; smaller levels are not made

  /// `levels` >= 1: requested number of levels; small images have fewer. The first build() allocates.
  explicit Pyramid(int levels);
  /// Allocates for images of this size.
  Pyramid(int levels, int width, int height);
  Pyramid(Pyramid&&) noexcept = default;
  Pyramid& operator=(Pyramid&&) noexcept = default;
  Pyramid(const Pyramid&) = delete;  // the views would refer to the pixels of the other
  Pyramid& operator=(const Pyramid&) = delete;

  /// Builds all levels. An empty view leaves the pyramid empty (levels() == 0).
  void build(const ImageView& image);

  int levels() const { return filled_; }
  const ImageView& level(int l) const { return views_[static_cast<std::size_t>(l)]; }
  /// Returns the pixels of level l per pixel of level 0: 2^-l.
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
