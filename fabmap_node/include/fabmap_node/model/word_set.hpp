// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fabmap_node {

using Word = std::uint32_t;

/// Distinct words of one observation, ascending. Counts are not used (Newman et al. 2009, section 3.1: z is binary).
using WordSet = std::vector<Word>;

/// Observations of one vocabulary, in order of time.
struct WordSets {
  std::size_t vocabulary_size = 0;
  std::vector<WordSet> observations;
};

}  // namespace fabmap_node
