// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/fuzz.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::testing {
namespace {

constexpr std::array kNastyWords = {
    "nan",  "-inf", "1e999", "-1e308", "1e-320",     "0",        "-0", "-1",   "18446744073709551616",
    "0x10", "1,5",  "1.5.2", "+",      "2147483648", "1_000",    "",   "\"",   "[[[[[[[[[[[[[[[[",
    "{}",   ":",    "- -",   "%s%n",   "\xff\xfe",   "\xc3\x28", "\r", "\t\t", "#"};

/// Returns the part of `text` around `position` without any of `separators`; empty on a separator.
std::pair<std::size_t, std::size_t> pieceAround(const std::string& text, std::size_t position, const char* separators) {
  const std::size_t end = std::min(text.find_first_of(separators, position), text.size());
  if (end == position || position == 0) return {position, end};
  const std::size_t before = text.find_last_of(separators, position - 1);
  return {before == std::string::npos ? 0 : before + 1, end};
}

std::string describe(const std::exception& error, const std::string& text) {
  constexpr std::size_t kShown = 2000;
  return std::string("neither accepted nor rejected with a UserError: ") + error.what() + "\nthe text:\n" +
         text.substr(0, kShown);
}

}  // namespace

Mutator::Mutator(std::vector<std::string> seeds, std::uint64_t seed) : seeds_(std::move(seeds)), random_(seed) {
  assert(!seeds_.empty());
}

std::size_t Mutator::below(std::size_t limit) { return limit == 0 ? 0 : static_cast<std::size_t>(random_() % limit); }

std::string Mutator::next() {
  std::string text = seeds_[below(seeds_.size())];
  const std::size_t count = 1 + below(4);
  for (std::size_t i = 0; i < count; ++i) mutateOnce(text);
  return text;
}

void Mutator::mutateOnce(std::string& text) {
  const std::size_t position = below(text.size());
  const auto [word, word_end] = pieceAround(text, position, " \t\n,;:[]{}");
  const auto [line, line_end] = pieceAround(text, position, "\n");
  const std::string whole_line = text.substr(line, line_end - line) + "\n";
  switch (below(10)) {
    case 0: text.insert(position, 1, static_cast<char>(below(256))); break;
    case 1:
      if (!text.empty()) text[position] = static_cast<char>(text[position] ^ (1 << below(8)));
      break;
    case 2: text.erase(position, 1 + below(8)); break;
    case 3: text.resize(position); break;
    case 4: text.replace(word, word_end - word, kNastyWords[below(kNastyWords.size())]); break;
    case 5: text.erase(word, word_end - word); break;
    case 6: text.insert(line, whole_line); break;
    case 7: text.erase(line, line_end - line + below(2)); break;
    case 8:
      text.insert(word, std::string(1 + below(300), text.empty() ? '9' : text[word < text.size() ? word : 0]));
      break;
    default: {
      const std::string& other = seeds_[below(seeds_.size())];
      text = text.substr(0, position) + other.substr(below(other.size()));
    }
  }
}

double fuzzSeconds() {
  const char* seconds = std::getenv("URBAN_NAV_FUZZ_SECONDS");
  return seconds == nullptr ? 0.3 : std::atof(seconds);
}

FuzzResult fuzzText(const std::vector<std::string>& seeds, const std::function<void(const std::string& text)>& read,
                    std::uint64_t seed) {
  FuzzResult result;
  const auto feed = [&](const std::string& text) {
    try {
      read(text);
      ++result.accepted;
    } catch (const Error&) {
      ++result.refused;
    } catch (const std::exception& error) {
      result.failure = describe(error, text);
    }
  };
  for (const std::string& text : seeds) feed(text);
  Mutator mutator(seeds, seed);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(fuzzSeconds());
  while (result.failure.empty() && std::chrono::steady_clock::now() < end) feed(mutator.next());
  return result;
}

FuzzResult fuzzFile(const std::vector<std::string>& seeds, const std::string& name,
                    const std::function<void(const std::string& path)>& read, std::uint64_t seed) {
  std::string folder = (std::filesystem::temp_directory_path() / "urban_nav_fuzz_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
  const std::string path = folder + "/" + name;
  FuzzResult result = fuzzText(
      seeds,
      [&](const std::string& text) {
        std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
        read(path);
      },
      seed);
  std::filesystem::remove_all(folder);
  return result;
}

}  // namespace urban_nav_core::testing
