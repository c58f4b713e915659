// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fabmap_node/vocabulary/vocabulary.hpp"

namespace fabmap_node {

struct KMeansOptions {
  std::size_t words = 4000;   ///< 2 ... 1 000 000
  int iterations = 12;        ///< at most
  std::uint64_t seed = 1;     ///< of the first centres
  std::size_t per_word = 60;  ///< descriptors used for each word at most, drawn evenly
};

/// Clusters descriptors by approximate k-means (Philbin et al., CVPR 2007): each iteration assigns by
/// Vocabulary::quantise(). Words without descriptors are placed anew where descriptors are farthest from their centre.
/// The result does not depend on the number of threads. `progress` is called with iterations done and in total.
/// Throws UserError if there are fewer descriptors than words.
Vocabulary trainVocabulary(std::vector<ByteDescriptor> descriptors, const KMeansOptions& options,
                           const std::function<void(int done, int total)>& progress = {});

}  // namespace fabmap_node
