// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fabmap_node/model/word_set.hpp"

namespace fabmap_node {

struct WeightedWord {
  Word word = 0;
  double weight = 0.0;
};

/// Inverted lists: of each word the places that contain it, in blocks of places whose sums stay in the first-level
/// cache while they are added up. Words that many places of a block contain are stored as bits of the places instead,
/// eight words in a byte, whose sums are looked up.
///
/// Memory: at most 2 bytes per word of a place, and 4 bytes per word of the vocabulary for every 4 096 places. Not
/// thread-safe while add() runs; const functions are.
class WordPostings {
 public:
  explicit WordPostings(std::size_t words) : open_(words) {}

  /// Adds a place; its number is the former size(). Requires words below the number of words.
  void add(const WordSet& place);
  std::size_t size() const { return size_; }

  /// Adds to the sum of each place the weights of those of `words` that it contains. Deterministic. Requires
  /// sums.size() == size(), and different words.
  void addWeights(const std::vector<WeightedWord>& words, std::vector<double>& sums) const;

 private:
  /// Eight words, one for each bit, and a byte for each place of the block.
  struct WordOctet {
    std::array<Word, 8> words{};
    std::vector<std::uint8_t> bits;
  };
  /// Places by words: those of word q are places[begin[q]] ... places[begin[q + 1]], by their numbers in the block.
  struct FullBlock {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint16_t> places;
    std::vector<WordOctet> frequent;  ///< words without a list
  };
  void closeBlock();
  std::vector<WordOctet> takeFrequentWords();

  std::size_t size_ = 0;
  std::vector<FullBlock> full_;
  std::vector<std::vector<std::uint16_t>> open_;  // of the last block, by words
};

}  // namespace fabmap_node
