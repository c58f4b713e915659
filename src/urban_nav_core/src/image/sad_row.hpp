// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace urban_nav_core::sad_row {

/// Search along a row. Own code instead of OpenCV's universal intrinsics, because those are compiled for the portable
/// baseline. The instruction set is chosen at run time; integer arithmetic makes the result independent of it.
struct InstructionSet {
  const char* name;
  int lanes;  ///< positions compared at once

  /// Computes the mean-removed SAD (patch.hpp) of a patch of 9 rows by 8 at `lanes` adjacent positions; `first`: upper
  /// left pixel of the first position.
  void (*compare)(const std::int16_t* patch, const std::uint8_t* first, std::ptrdiff_t stride, int* sads);
};

/// Returns the instruction sets that this machine supports, fastest first. The last one is supported everywhere.
std::vector<InstructionSet> instructionSets();

}  // namespace urban_nav_core::sad_row
