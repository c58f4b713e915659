// SPDX-License-Identifier: BSD-3-Clause
#include "folder/unused_files.hpp"

#include <filesystem>

namespace urban_nav_input {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostNamed = 8;

}  // namespace

std::string describeUnusedFiles(const std::string& folder, const std::set<std::string>& used) {
  std::set<std::string> unused;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.empty() || name.front() == '.' || used.count(name) > 0) continue;
    unused.insert(name + (entry.is_directory(error) ? "/" : ""));
  }
  std::string sentence;
  std::size_t named = 0;
  for (const std::string& name : unused) {
    if (named++ == kMostNamed) return sentence + " and " + std::to_string(unused.size() - kMostNamed) + " more";
    sentence += (sentence.empty() ? "not used: " : ", ") + name;
  }
  return sentence;
}

std::string firstPartWithin(const std::string& folder, const std::string& path) {
  const fs::path relative = fs::path(path).lexically_relative(folder);
  return relative.empty() || *relative.begin() == ".." ? std::string() : relative.begin()->string();
}

}  // namespace urban_nav_input
