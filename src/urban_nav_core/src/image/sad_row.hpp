// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace urban_nav_core::sad_row {

/// The search along a row, own code beside OpenCV's universal intrinsics because those are compiled for the portable
/// baseline: chosen at run time by what the processor can do. All of it is integers, so that the choice does not show
/// in the result.
struct InstructionSet {
  const char* name;
  int lanes;  ///< places compared at once

  /// Mean-removed SAD (patch.hpp) of a patch of 9 rows by 8 at `lanes` places side by side; `first`: upper left pixel
  /// of the first.
  void (*compare)(const std::int16_t* patch, const std::uint8_t* first, std::ptrdiff_t stride, int* sads);
};

/// What this machine can run, fastest first. The last is always there.
std::vector<InstructionSet> instructionSets();

}  // namespace urban_nav_core::sad_row
