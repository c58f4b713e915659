// SPDX-License-Identifier: BSD-3-Clause
#include "recording/foreign_file.hpp"

#include <fstream>
#include <string_view>

#include "urban_nav_core/io/file_kind.hpp"

namespace urban_nav_input {

namespace {

constexpr std::size_t kHeadBytes = 65536;
constexpr std::string_view kSqlite("SQLite format 3", 15);
constexpr const char* kAnInput = "a bag or a folder of images";

std::string readHead(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(kHeadBytes, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

/// Returns whether the header of a database has an application ID, as that of a session store
/// (sqlite.org/fileformat.html, section 1.3).
bool hasApplication(const std::string& head) {
  constexpr std::size_t kApplication = 68, kBytes = 4;
  return head.size() >= kApplication + kBytes && head.substr(kApplication, kBytes) != std::string(kBytes, '\0');
}

}  // namespace

std::optional<ForeignInput> recogniseForeignFile(const std::string& path) {
  const std::string head = readHead(path);
  if (head.compare(0, kSqlite.size(), kSqlite) == 0) {
    if (!hasApplication(head))
      return ForeignInput{"is a database without the rosbag2 tables topics and messages", "a .db3 of rosbag2"};
    return ForeignInput{"is a session store, not a recording", "--store " + path + " continues it"};
  }
  const std::string found = urban_nav_core::describeForeignContent(head);
  if (found.empty()) return std::nullopt;
  const std::size_t program = found.rfind(' ') + 1;
  if (found.find("compressed by") != std::string::npos)
    return ForeignInput{found, "the bag itself: `" + found.substr(program) + " -d " + path + "`"};
  return ForeignInput{found, kAnInput};
}

}  // namespace urban_nav_input
