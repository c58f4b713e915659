// SPDX-License-Identifier: BSD-3-Clause
#include "live/split_words.hpp"

namespace urban_nav_sim {

std::vector<std::string> splitWords(const std::string& text) {
  std::vector<std::string> words;
  constexpr const char* kSeparators = ", \t\n";
  for (std::size_t begin = text.find_first_not_of(kSeparators); begin != std::string::npos;) {
    const std::size_t end = text.find_first_of(kSeparators, begin);
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kSeparators, end);
  }
  return words;
}

}  // namespace urban_nav_sim
