// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/types/stereo_pair.hpp"

namespace swf_vo {

/// Detects image rows corrupted by incomplete transfers. A lens spreads each point over more than a row, so that the
/// roughness of neighbouring rows is similar at each position, and below that of random bytes: this is violated at most
/// at 1 % of the positions in all real and rendered images tested, including bare trees at half resolution. With 10 %
/// random rows it is violated at 16 % of the positions, and at 10 % if rectification has bent the rows. Images are
/// independent; no previous image is needed. Not detected below about 2 % of the rows, and mostly not for missing or
/// grey rows. Samples two of four rows, and half of their pixels; does not allocate.
bool looksCorrupted(const urban_nav_core::ImageView& image);

/// Repairs corrupted rows by interpolation, so that the rest of the image can be matched.
class CorruptRowRepair {
 public:
  /// `width`, `height`: size of the images; images of another size are returned unchanged.
  CorruptRowRepair(int width, int height);

  struct Repaired {
    urban_nav_core::StereoPair pair;  ///< views of the input where it is good, of this object's pixels where it is not
    bool corrupted = false;           ///< in one image or both
  };
  /// Replaces segments of 32 columns whose roughness is much larger than the smallest one of the next three rows above
  /// and below by linear interpolation between the nearest good rows. The views are valid until the next call. Does not
  /// allocate.
  Repaired repair(const urban_nav_core::StereoPair& pair);

 private:
  void repair(const urban_nav_core::ImageView& image, std::vector<std::uint8_t>& pixels);
  void findCorrupted(const urban_nav_core::ImageView& image, int column);
  void bridge(std::vector<std::uint8_t>& pixels, int column, int count) const;

  int width_, height_;
  std::vector<std::uint8_t> left_, right_;
  std::vector<unsigned> roughness_;  // per row, in one segment
  std::vector<bool> corrupted_;      // per row, in one segment
};

}  // namespace swf_vo
