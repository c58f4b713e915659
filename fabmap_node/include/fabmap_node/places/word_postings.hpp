// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fabmap_node/model/word_set.hpp"

namespace fabmap_node {
/// A word of an observation with its weight.
struct WeightedWord {
  Word word = 0;
  double weight = 0.0;
};

/// Inverted lists: for each word, the places that contain it, in blocks of places whose sums fit the first-level cache.
/// Words contained in many places of a block are stored as bits per place instead, eight words in a byte, with sums
/// from a lookup table.
///
/// Memory: at most 2 bytes per word of a place, and 4 bytes per word of the vocabulary for every 4 096 places. Not
/// thread-safe while add() runs; const functions are.
class WordPostings {
 public:
  explicit WordPostings(std::size_t words) : open_(words) {}

  /// Adds a place, whose number is the previous size(). Requires words below the number of words.
  void add(const WordSet& place);
  std::size_t size() const { return size_; }

  /// Adds to the sum of each place the weights of the `words` that it contains. Deterministic. Requires sums.size() ==
  /// size(), and distinct words.
  void addWeights(const std::vector<WeightedWord>& words, std::vector<double>& sums) const;

 private:
  /// Eight words, one per bit, with a byte for each place of the block.
  struct WordOctet {
    std::array<Word, 8> words{};
    std::vector<std::uint8_t> bits;
  };
  /// Places by word: those of word q are places[begin[q]] ... places[begin[q + 1]], numbered within the block.
  struct FullBlock {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint16_t> places;
    std::vector<WordOctet> frequent;  ///< words without a list
  };
  void closeBlock();
  std::vector<WordOctet> takeFrequentWords();

  std::size_t size_ = 0;
  std::vector<FullBlock> full_;
  std::vector<std::vector<std::uint16_t>> open_;  // last block, by word
};

}  // namespace fabmap_node
