// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/model/word_bytes.hpp"

#include "model/number_bytes.hpp"

namespace fabmap_node {

std::vector<std::uint8_t> packWords(const WordSet& words) {
  std::vector<std::uint8_t> steps;
  Word before = 0;
  for (const Word word : words) {
    putNumber(steps, word - before);
    before = word;
  }
  return steps;
}

std::optional<WordSet> unpackWords(const std::vector<std::uint8_t>& bytes, std::size_t vocabulary_size) {
  WordSet words;
  std::uint64_t word = 0;
  for (NumberReader reader(bytes); !reader.atEnd();) {
    const std::uint32_t step = reader.next();
    word += step;
    if (!reader.isValid() || word >= vocabulary_size || (step == 0 && !words.empty())) return std::nullopt;
    words.push_back(static_cast<Word>(word));
  }
  return words;
}

}  // namespace fabmap_node
