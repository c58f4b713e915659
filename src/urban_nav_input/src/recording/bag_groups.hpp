// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

/// Bags of a recording that were written at the same time, and are read as one.
struct BagGroup {
  std::vector<RecordingFile*> bags;
  std::size_t end = 0;                  ///< bags up to the last of these, in the order of the recording
  urban_nav_core::StampNs receipt = 0;  ///< of the last message
};

/// The bags of a recording, which begin one after the other: a new group begins where all messages of the bags before
/// were received before the first of it. The recording must outlive it.
std::vector<BagGroup> groupBags(Recording& recording);
/// All of them as one group: stamps of one bag may lie between those of another.
std::vector<BagGroup> asOneGroup(const std::vector<BagGroup>& groups);

}  // namespace urban_nav_input
