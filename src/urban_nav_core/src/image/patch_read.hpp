// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace urban_nav_core::patch_read {

/// Inner loops of an alignment step. Own code instead of OpenCV's universal intrinsics, because those are compiled for
/// the portable baseline. The instruction set is chosen at run time. Summation order is fixed and no operations are
/// fused, so results are bit-identical for all instruction sets.
constexpr int kTaps = 6;   ///< of a filter along one axis; the outermost are zero without blur
constexpr int kRows = 11;  ///< of the window (patch.hpp), stored in rows of 12

/// Sums over the window of pixels times filters.
struct Sums {
  float along_x, along_y, gain, mean, square;
};

struct InstructionSet {
  const char* name;

  /// Reads the window at a subpixel position. `first`: pixel of the first taps of the window's first pixel; 16 by 16
  /// pixels are read.
  void (*read)(const std::uint8_t* first, std::ptrdiff_t stride, const float* weights_x, const float* weights_y,
               bool blurs, float* window);

  /// Computes the sums. All arrays have kRows x 12 elements.
  Sums (*measure)(const float* window, const float* weight, const float* filter_x, const float* filter_y,
                  const float* filter_gain);
};

/// Returns the instruction sets that this machine supports, fastest first. The last one is supported everywhere.
std::vector<InstructionSet> instructionSets();

const InstructionSet& fastest();

}  // namespace urban_nav_core::patch_read
