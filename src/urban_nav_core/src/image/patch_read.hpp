// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace urban_nav_core::patch_read {

/// What an alignment does at each step, own code beside OpenCV's universal intrinsics because those are compiled for
/// the portable baseline: chosen at run time by what the processor can do. Each sum runs in the same order and nothing
/// is fused, so the bits do not depend on that choice.
constexpr int kTaps = 6;   ///< of a filter along one axis; the outermost are zero where nothing is blurred
constexpr int kRows = 11;  ///< of the window (patch.hpp), in lines of 12

/// Sums over the window of pixels times filters.
struct Sums {
  float along_x, along_y, gain, mean, square;
};

struct InstructionSet {
  const char* name;

  /// The window at a place between pixels: `first` is the pixel that the first taps of its first pixel meet; 16 by 16
  /// pixels are read.
  void (*read)(const std::uint8_t* first, std::ptrdiff_t stride, const float* weights_x, const float* weights_y,
               bool blurs, float* window);

  /// All arrays of rows x 12.
  Sums (*measure)(const float* window, const float* weight, const float* filter_x, const float* filter_y,
                  const float* filter_gain);
};

/// What this machine can run, fastest first. The last is always there.
std::vector<InstructionSet> instructionSets();

const InstructionSet& fastest();

}  // namespace urban_nav_core::patch_read
