// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "padded.hpp"
#include "sgm/descriptors.hpp"

namespace dense_stereo {

/// Penalties of semi-global matching, in units of the cost (one per differing census bit or grey level of gradient).
struct Penalties {
  int step = 14;           ///< P1: the disparity changes by one
  int jump = 60;           ///< P2: it changes by more, between pixels of equal brightness
  int least_jump = 30;     ///< P2 at strong edges of the image
  int jump_slope = 2;      ///< decrease of P2 per grey level between the two pixels
  int gradient_limit = 6;  ///< limit of the cost of the gradients' difference, grey levels
};

/// Best disparity of each pixel.
struct Winners {
  static constexpr std::uint16_t kInvalid = 65535;
  Padded<std::uint16_t> disparity;  ///< px, `kInvalid` where the right image's best disparity differs by more than two
  Padded<std::uint8_t> cost;        ///< sum of the three path costs at the best disparity, saturated
  Padded<std::uint8_t> rival;       ///< smallest sum at disparities that differ by more than one, saturated
};

/// Semi-global matching (Hirschmueller 2008) along three paths, from the left, from above and from the right, in one
/// pass over the rows. Costs of one row are kept instead of a volume: time per row is proportional to width times
/// disparities, memory is that of two rows. Path costs and their sum are 8-bit and saturate. Pixels near the left
/// border, whose match may lie outside the right image, are compared over the remaining disparities. V: Bytes, or
/// PlainBytes for the reference, with the same result. Not thread-safe.
template <typename V>
class SemiGlobal {
 public:
  /// Allocates for images of this size. `disparities`: 16...512, a multiple of 16; the search range is 0...disparities
  /// - 1 px.
  void resize(int width, int height, int disparities);
  /// Matches images of the size given to resize(), with rows extended by extendRows().
  void match(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right, const Penalties& penalties,
             Winners& winners);

 private:
  /// `is_wide`: disparities do not fit 8 bits.
  template <int blocks, bool is_wide>
  void matchRows(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right, Winners& winners);
  template <int blocks>
  void sweepRight(const std::uint8_t* pixels, const std::uint8_t* pixels_above);
  template <int blocks, bool is_wide>
  void sweepLeft(const std::uint8_t* pixels, std::uint16_t* disparity, std::uint8_t* cost, std::uint8_t* rival);
  void checkAgainstRight(std::uint16_t* disparity) const;

  int width_ = 0, height_ = 0, disparities_ = 0;
  Penalties penalties_;
  std::array<std::uint8_t, 256> jumps_{};  ///< P2 by the difference of grey levels
  DescriptorRow left_row_, right_row_;
  std::vector<std::uint8_t> costs_, sums_;                  ///< of one row, width x disparities
  std::vector<std::uint8_t> above_, above_least_;           ///< path from above: previous row
  std::array<std::vector<std::uint8_t>, 2> along_;          ///< path along the row: previous and current pixel
  std::vector<std::uint8_t> right_cost_, right_disparity_;  ///< best disparities of the right image, from its right end
  std::vector<std::uint8_t> right_high_;                    ///< their higher bytes; not used if they fit 8 bits
  std::vector<std::uint8_t> around_;                        ///< 255 at the best disparity and its neighbours, else 0
};

}  // namespace dense_stereo
