// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/printable.hpp"

#include <cstddef>
#include <cstdint>

namespace urban_nav_core {

namespace {

struct Character {
  std::size_t size = 1;    // bytes
  std::uint32_t code = 0;  // of Unicode
  bool is_valid = false;
};

/// Returns the first character of a text by RFC 3629, section 4: shortest form, no surrogates.
Character firstCharacter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80U) return {1, first, true};
  const std::size_t size = first >= 0xf0U ? 4 : first >= 0xe0U ? 3 : 2;
  if (first < 0xc2U || first > 0xf4U || text.size() < size) return {};
  Character character{size, first & (0x7fU >> size), true};
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return {};
    character.code = character.code << 6U | (byte(i) & 0x3fU);
  }
  const std::uint32_t least = size == 4 ? 0x10000U : size == 3 ? 0x800U : 0x80U;
  const bool is_surrogate = character.code >= 0xd800U && character.code < 0xe000U;
  return character.code < least || character.code > 0x10ffffU || is_surrogate ? Character{} : character;
}

bool isShown(const Character& character) {
  const std::uint32_t code = character.code;
  const bool is_control = code < 0x20U || (code >= 0x7fU && code < 0xa0U);
  const bool is_line_end = code == 0x2028U || code == 0x2029U;
  const bool turns = code == 0x200eU || code == 0x200fU || (code >= 0x202aU && code <= 0x202eU) ||
                     (code >= 0x2066U && code <= 0x2069U);
  return character.is_valid && !is_control && !is_line_end && !turns;
}

}  // namespace

std::string printable(std::string_view text, std::string_view keep) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const Character character = firstCharacter(text);
    const std::string_view bytes = text.substr(0, character.size);
    if (isShown(character) || keep.find(bytes) != std::string_view::npos) {
      shown += bytes;
    } else {
      for (const char byte : bytes) {
        shown += "\\x";
        shown += kDigits[static_cast<unsigned char>(byte) >> 4U];
        shown += kDigits[static_cast<unsigned char>(byte) & 15U];
      }
    }
    text.remove_prefix(character.size);
  }
  return shown;
}

}  // namespace urban_nav_core
