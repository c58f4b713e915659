// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fabmap_node/model/word_set.hpp"

namespace fabmap_node {

/// Encodes the differences of consecutive words, one or two bytes each.
std::vector<std::uint8_t> packWords(const WordSet& words);
/// Inverse of packWords(); nullopt if the bytes are damaged, or a word is not below `vocabulary_size`.
std::optional<WordSet> unpackWords(const std::vector<std::uint8_t>& bytes, std::size_t vocabulary_size);

}  // namespace fabmap_node
