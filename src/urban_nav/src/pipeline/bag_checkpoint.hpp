// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/sessions.hpp"

namespace urban_nav {

/// Where `map` stood at the end of a bag: what the store keeps, so that the next bag of the recording goes on without a seam.
struct BagState {
  std::vector<std::string> bags;        ///< all that are behind it (bagsOf), from the first of the session on
  urban_nav_core::StampNs receipt = 0;  ///< of the last message
  std::string reader, vo;               ///< states of the reader and of VoStage
};

std::string packBagState(BagState state);
/// DataError where the bytes are something else, of another version, or damaged.
BagState unpackBagState(std::string_view bytes);

/// How many of a session's bags are behind the state: those that its last ones are, or none where the first was received less than kLongestSplit
/// behind the end. Empty where they do not follow it.
std::optional<std::size_t> bagsBehind(const BagState& state, const std::vector<std::string>& bags,
                                      urban_nav_core::StampNs begin);

}  // namespace urban_nav
