// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "urban_nav_core/types/stereo_pair.hpp"

namespace swf_vo {

/// Detects image rows corrupted by incomplete transfers. A lens spreads each point over more than a row, so that
/// neighbouring rows are about equally rough, place by place, and never as rough as random bytes: at most 1 % of the
/// places say otherwise, of all real and rendered pictures tried, bare trees at half resolution included. Where 10 % of
/// the rows are random it is 16 % of the places, and 10 % where rectification has bent them. Each image for itself:
/// none before it is needed. Below some 2 % of the rows it says no, and so it mostly does of rows that are missing or
/// grey. Looks at two of four rows, and at half of their pixels; allocates nothing.
bool looksCorrupted(const urban_nav_core::ImageView& image);

/// Repairs corrupted rows by interpolation, so that the rest of the image can be matched.
class CorruptRowRepair {
 public:
  /// Of images of this size; others are left as they are.
  CorruptRowRepair(int width, int height);

  struct Repaired {
    urban_nav_core::StereoPair pair;  ///< views of what came where it is good, of this object's pixels where it is not
    bool corrupted = false;           ///< one image or both
  };
  /// Places of rows that are much rougher than the least rough of the next three rows above and below become the
  /// straight line between the good rows on both sides, from 32 columns to 32. The views live until the next call.
  /// Allocates nothing.
  Repaired repair(const urban_nav_core::StereoPair& pair);

 private:
  void repair(const urban_nav_core::ImageView& image, std::vector<std::uint8_t>& pixels);
  void findCorrupted(const urban_nav_core::ImageView& image, int column);
  void bridge(std::vector<std::uint8_t>& pixels, int column, int count) const;

  int width_, height_;
  std::vector<std::uint8_t> left_, right_;
  std::vector<unsigned> roughness_;  // of the rows, at one place
  std::vector<bool> corrupted_;      // likewise
};

}  // namespace swf_vo
