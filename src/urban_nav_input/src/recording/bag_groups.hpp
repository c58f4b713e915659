// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

/// Bags of a recording that were written concurrently, and are read as one.
struct BagGroup {
  std::vector<RecordingFile*> bags;
  std::size_t end = 0;                  ///< index after the last of these bags, in the order of the recording
  urban_nav_core::StampNs receipt = 0;  ///< of the last message
};

/// Groups the bags of a recording, in the order of their begin: a new group begins with a bag whose messages were all
/// received after those of the previous bags. The recording must outlive the result.
std::vector<BagGroup> groupBags(Recording& recording);
/// Returns all bags as one group, if stamps of one bag are between those of another.
std::vector<BagGroup> asOneGroup(const std::vector<BagGroup>& groups);

}  // namespace urban_nav_input
