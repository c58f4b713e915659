// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "padded.hpp"

namespace dense_stereo {

/// Data compared by the matching cost at each pixel of a row: 32 bits of two census transforms and the horizontal
/// gradient.
///
/// Census (Zabih and Woodfill 1994): 24 bits compare pixels that are opposite each other in a window of 7x7
/// (center-symmetric: Spangenberg et al. 2013), 8 bits compare the pixel with its neighbours. `nibbles[k][x]` holds
/// four of them, so that a table of 16 entries counts differences. Gradient: 128 plus half the difference of the
/// neighbouring columns, each averaged over three rows.
struct DescriptorRow {
  static constexpr int kNibbleCount = 8;
  static constexpr int kBits = 4 * kNibbleCount;

  /// Allocates for rows of `width` pixels; the right image's row is read up to `disparities` elements past its end.
  void resize(int width, int disparities);

  std::array<std::uint8_t*, kNibbleCount> nibbles{};
  std::uint8_t* gradient = nullptr;

 private:
  std::vector<std::uint8_t> memory_;
};

enum class PixelOrder {
  Forward,   ///< element x describes pixel x
  Backward,  ///< element x describes pixel width - 1 - x: disparities grow along the row
};

/// Computes the descriptors of row v of an image whose rows have been extended by at least 16 pixels on both sides.
/// Rows outside the image repeat the border.
template <typename V>
void describeRow(const Padded<std::uint8_t>& image, int v, PixelOrder order, DescriptorRow& row);

/// Extends each row on both sides by repeating its border pixels.
void extendRows(Padded<std::uint8_t>& image);

}  // namespace dense_stereo
