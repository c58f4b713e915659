// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace urban_nav_core::fast_score {

/// Inner loop of FAST. Own code instead of OpenCV's universal intrinsics, because those are compiled for the portable
/// baseline and this loop is half of the front end's time on pixels. The instruction set is chosen at run time; integer
/// arithmetic makes the result independent of it.
struct InstructionSet {
  const char* name;

  /// Computes the scores of the pixels [begin, end) of a row (fast.hpp); zero for pixels that are not corners at the
  /// threshold. Reads no more than `radius` rows and columns around them. Returns whether there is a corner.
  bool (*scoreRow)(const std::uint8_t* row, std::ptrdiff_t stride, int begin, int end, int threshold,
                   std::uint8_t* scores);
};

/// Returns the instruction sets that this machine supports, fastest first. The last one is supported everywhere.
std::vector<InstructionSet> instructionSets();

}  // namespace urban_nav_core::fast_score
