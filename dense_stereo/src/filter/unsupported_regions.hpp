// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "padded.hpp"
#include "refine/slanted_alignment.hpp"
#include "sgm/semi_global.hpp"

namespace dense_stereo {

/// Removes disparities that are not supported by texture: semi-global matching propagates the disparities of a building
/// into the sky above it. A pixel has evidence if the images determine its disparity (information relative to noise),
/// or if no other disparity explains the pixels as well (distance of the second best), or a combination of both. In a
/// window of 21x21 with little evidence, pixels without evidence or in a flat neighbourhood are unsupported; small flat
/// patches within texture are supported. Flat pixels that connect an unsupported region to an outline are unsupported
/// too, since their evidence is that of the outline in their windows. Keeps its buffers. Not thread-safe.
class UnsupportedRegions {
 public:
  /// Invalidates unsupported pixels of the field. `left`: rows extended by extendRows().
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
  Padded<std::uint8_t> outline_, beside_;  ///< 255: high contrast in 3x3 px; flat and near such a pixel
  Padded<std::uint8_t> removed_, grown_;   ///< 255: unsupported
  Padded<std::uint16_t> sums_;             ///< over the window
  std::vector<std::uint16_t> column_;
};

}  // namespace dense_stereo
