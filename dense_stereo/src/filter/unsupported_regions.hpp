// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "padded.hpp"
#include "refine/slanted_alignment.hpp"
#include "sgm/semi_global.hpp"

namespace dense_stereo {

/// Finds disparities that no texture supports: semi-global matching carries the disparities of a building into the
/// sky above it. A pixel has evidence if the images fix its disparity (information against noise) or no other
/// disparity explains the pixels as well (distance of the rival), or something of both. Where a window of 21x21 holds
/// little evidence, pixels in it that have none, or whose own neighbourhood is flat, are unsupported; small flat
/// patches within texture are supported. Flat pixels that lead from an unsupported region towards an outline are
/// unsupported too: their evidence is the outline's, which their windows hold. Keeps its memory. Not thread-safe.
class UnsupportedRegions {
 public:
  /// Makes unsupported pixels of the field invalid. `left`: rows extended by extendRows.
  void remove(const Padded<std::uint8_t>& left, const Winners& winners, DisparityField& field);

 private:
  static constexpr int kRadius = 10;  ///< px, of the window

  void markFlat(const Padded<std::uint8_t>& left);
  void markEvidence(const Padded<std::uint8_t>& left, const Winners& winners, const DisparityField& field);
  void sumWindows();
  void markPoorWindows();
  void markBesideOutlines();
  void growThroughFlat();
  void growOverBlur(const Padded<std::uint8_t>& left);

  Padded<std::uint8_t> flat_, evidence_;   ///< 255: yes; 1: yes
  Padded<std::uint8_t> outline_, beside_;  ///< 255: much contrast in 3x3 px; flat, and near such a pixel
  Padded<std::uint8_t> removed_, grown_;   ///< 255: unsupported
  Padded<std::uint16_t> sums_;             ///< over the window
  std::vector<std::uint16_t> column_;
};

}  // namespace dense_stereo
