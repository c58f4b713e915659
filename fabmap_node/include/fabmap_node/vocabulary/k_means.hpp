// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fabmap_node/vocabulary/vocabulary.hpp"

namespace fabmap_node {
/// Options of the clustering of descriptors.
struct KMeansOptions {
  std::size_t words = 4000;   ///< 2 ... 1 000 000
  int iterations = 12;        ///< limit
  std::uint64_t seed = 1;     ///< for the initial centres
  std::size_t per_word = 60;  ///< limit of descriptors per word, drawn evenly
};

/// Clusters descriptors by approximate k-means (Philbin et al., CVPR 2007): each iteration assigns by
/// Vocabulary::quantise(). Empty clusters are reinitialised at the descriptors farthest from their centres. The result
/// does not depend on the number of threads. `progress` is called with iterations done and in total. Throws UserError
/// if there are fewer descriptors than words.
Vocabulary trainVocabulary(std::vector<ByteDescriptor> descriptors, const KMeansOptions& options,
                           const std::function<void(int done, int total)>& progress = {});

}  // namespace fabmap_node
