// SPDX-License-Identifier: BSD-3-Clause
#include "session/foreign_input.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "urban_nav_core/io/file_kind.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHeadBytes = 65536;
constexpr std::string_view kSqlite("SQLite format 3", 15);
constexpr std::size_t kNamedBags = 3;
constexpr const char* kAnInput = "a bag or a folder of images";

std::string readHead(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(kHeadBytes, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool beginsWith(std::string_view bytes, std::string_view signature) {
  return bytes.substr(0, signature.size()) == signature;
}

bool holds(const std::string& bytes, const char* words) { return bytes.find(words) != std::string::npos; }

/// Returns whether the header of a database names the program that it belongs to, as that of a session store does
/// (sqlite.org/fileformat.html, section 1.3).
bool hasApplication(const std::string& head) {
  constexpr std::size_t kApplication = 68, kBytes = 4;
  return head.size() >= kApplication + kBytes && head.substr(kApplication, kBytes) != std::string(kBytes, '\0');
}

std::optional<ForeignInput> recogniseFile(const fs::path& path) {
  const std::string head = readHead(path);
  if (beginsWith(head, kSqlite)) {
    if (!hasApplication(head))
      return ForeignInput{"is a database without the tables topics and messages of rosbag2", "a .db3 of rosbag2"};
    return ForeignInput{"is a store, not a recording", "--store " + path.string() + " continues it"};
  }
  const std::string found = urban_nav_core::describeForeignContent(head);
  if (found.empty()) return std::nullopt;
  const std::size_t program = found.rfind(' ') + 1;
  if (holds(found, "compressed by"))
    return ForeignInput{found, "the bag itself: `" + found.substr(program) + " -d " + path.string() + "`"};
  return ForeignInput{found, kAnInput};
}

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
  return fs::is_directory(path) ? recogniseFolder(path) : recogniseFile(path);
}

}  // namespace urban_nav_input
