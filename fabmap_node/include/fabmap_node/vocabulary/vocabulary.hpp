// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fabmap_node/features/place_observation.hpp"
#include "fabmap_node/model/word_set.hpp"

namespace fabmap_node {

/// Visual vocabulary: cluster centres of descriptors, 8 bits per element, with approximate nearest neighbour search.
///
/// The centres are grouped about some sqrt(V) coarse centres. A search visits the nearest groups only: 97 % of the
/// words are the exact nearest ones, at a tenth of the time (bench, words). Groups and results are the same on every
/// machine. Const functions are thread-safe.
class Vocabulary {
 public:
  Vocabulary() = default;
  explicit Vocabulary(std::vector<ByteDescriptor> centres);

  std::size_t size() const { return centres_.size(); }
  const std::vector<ByteDescriptor>& centres() const { return centres_; }

  /// Returns the nearest word of the groups visited. Requires a vocabulary that is not empty.
  Word quantise(const ByteDescriptor& descriptor) const;
  /// Returns the exact nearest word: the reference for quantise().
  Word quantiseExactly(const ByteDescriptor& descriptor) const;
  /// Returns the distinct words of an observation, ascending.
  WordSet words(const PlaceObservation& observation) const;

 private:
  using Columns = Eigen::Matrix<float, static_cast<int>(kDescriptorBytes), Eigen::Dynamic>;
  struct CentreGroup {
    std::vector<Word> words;    // ascending
    Columns centres;            // one column per word
    Eigen::VectorXf half_norm;  // half their squared norms
  };
  void group();

  std::vector<ByteDescriptor> centres_;
  Columns coarse_;
  Eigen::VectorXf coarse_half_norm_;
  std::vector<CentreGroup> groups_;
};

}  // namespace fabmap_node
