// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace urban_nav_core::fast_score {

/// The inner loop of FAST, own code beside OpenCV's universal intrinsics because those are compiled for the portable
/// baseline, and half of the front end's reading of pixels is here: chosen at run time by what the processor can do.
/// All of it is integers, so that the choice does not show in the result.
struct InstructionSet {
  const char* name;

  /// Scores of the pixels [begin, end) of a row (fast.hpp); zero for those that are no corner at the threshold. Reads
  /// `radius` rows and columns around them and nothing else. Says whether there is a corner.
  bool (*scoreRow)(const std::uint8_t* row, std::ptrdiff_t stride, int begin, int end, int threshold,
                   std::uint8_t* scores);
};

/// What this machine can run, fastest first. The last is always there.
std::vector<InstructionSet> instructionSets();

}  // namespace urban_nav_core::fast_score
