// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fabmap_node/features/place_observation.hpp"
#include "fabmap_node/model/word_set.hpp"

namespace fabmap_node {

/// Visual vocabulary: cluster centres of descriptors, 8 bits per element, and an approximate search for the nearest
/// one.
///
/// The centres are grouped about some sqrt(V) coarse centres. A search visits the nearest groups only: 97 % of the
/// words are the nearest ones, at a tenth of the time (bench, words). Groups and results are the same on every machine.
/// Const functions are thread-safe.
class Vocabulary {
 public:
  Vocabulary() = default;
  explicit Vocabulary(std::vector<ByteDescriptor> centres);

  std::size_t size() const { return centres_.size(); }
  const std::vector<ByteDescriptor>& centres() const { return centres_; }

  /// Returns a word whose centre is near; the nearest one of the groups visited. Requires a vocabulary that is not
  /// empty.
  Word quantise(const ByteDescriptor& descriptor) const;
  /// Returns the nearest word by comparison with all centres: the reference for quantise().
  Word quantiseExactly(const ByteDescriptor& descriptor) const;
  /// Returns the words of an observation, ascending, each once.
  WordSet words(const PlaceObservation& observation) const;

 private:
  using Columns = Eigen::Matrix<float, static_cast<int>(kDescriptorBytes), Eigen::Dynamic>;
  struct CentreGroup {
    std::vector<Word> words;    // ascending
    Columns centres;            // a column for each of them
    Eigen::VectorXf half_norm;  // half their squared norms
  };
  void group();

  std::vector<ByteDescriptor> centres_;
  Columns coarse_;
  Eigen::VectorXf coarse_half_norm_;
  std::vector<CentreGroup> groups_;
};

}  // namespace fabmap_node
