// SPDX-License-Identifier: BSD-3-Clause
#include "session/foreign_input.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kNamedBags = 3;

std::optional<ForeignInput> recogniseFolder(const fs::path& path) {
  std::vector<std::string> bags;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (entry.is_regular_file(error) && isRecording(entry.path().string())) bags.push_back(entry.path().string());
  }
  if (bags.empty()) return std::nullopt;
  std::sort(bags.begin(), bags.end());
  std::string names;
  for (std::size_t i = 0; i < std::min(bags.size(), kNamedBags); ++i) names += (i > 0 ? " " : "") + bags[i];
  return ForeignInput{
      "is a folder of " + std::to_string(bags.size()) + (bags.size() == 1 ? " recording" : " recordings"),
      "the recordings themselves: " + names + (bags.size() > kNamedBags ? " ..." : "")};
}

}  // namespace

std::optional<ForeignInput> recogniseForeignInput(const std::string& path) {
  return fs::is_directory(path) ? recogniseFolder(path) : recogniseForeignFile(path);
}

}  // namespace urban_nav_input
