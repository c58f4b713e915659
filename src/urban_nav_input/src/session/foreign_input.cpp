// SPDX-License-Identifier: BSD-3-Clause
#include "session/foreign_input.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include "urban_nav_core/io/file_kind.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHeadBytes = 65536;  // the head of a file: SQLite's schema, an MCAP file's first record
constexpr std::string_view kMcap("\x89MCAP0\r\n", 8), kSqlite("SQLite format 3", 15);
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

/// Returns the profile in the first record of an MCAP file, "ros1" or "ros2"; empty without one.
std::string mcapProfile(std::string_view bytes) {
  constexpr std::size_t kLength = 17, kText = 21;  // after the magic, an opcode and the record's length
  if (bytes.size() < kText || bytes[kMcap.size()] != '\x01') return {};
  const auto size = static_cast<std::size_t>(static_cast<unsigned char>(bytes[kLength]));
  return std::string(bytes.substr(kText, size));
}

ForeignInput describeRos2Bag(const fs::path& path, const std::string& storage) {
  const fs::path name = path.has_filename() ? path.stem() : path.parent_path().stem();
  return {"is a ROS 2 bag (" + storage + ")", "`rosbags-convert --src " + path.string() + " --dst " + name.string() +
                                                  ".bag` makes a ROS 1 bag of it (Python package rosbags)"};
}

std::optional<ForeignInput> recogniseFile(const fs::path& path) {
  const std::string head = readHead(path);
  if (beginsWith(head, kMcap)) {
    if (mcapProfile(head) == "ros1")
      return ForeignInput{"holds ROS 1 messages in an MCAP file", "the ROS 1 bag that it was made from"};
    return describeRos2Bag(path, "MCAP");
  }
  if (beginsWith(head, kSqlite)) {
    if (path.extension() == ".db3" || (holds(head, "CREATE TABLE messages") && holds(head, "CREATE TABLE topics")))
      return describeRos2Bag(path, "SQLite");
    return ForeignInput{"is a store, not a recording", "--store " + path.string() + " continues it"};
  }
  const std::string found = urban_nav_core::describeForeignContent(head);
  if (found.empty()) return std::nullopt;
  const std::size_t program = found.rfind(' ') + 1;
  if (holds(found, "compressed by"))
    return ForeignInput{found, "the bag itself: `" + found.substr(program) + " -d " + path.string() + "`"};
  return ForeignInput{found, kAnInput};
}

/// Returns the files that a rosbag2 folder's metadata.yaml lists.
std::vector<std::string> listedFiles(const fs::path& metadata) {
  std::vector<std::string> names;
  bool is_listing = false;
  urban_nav_core::forEachLine(readHead(metadata), [&](std::string_view line, int) {
    const std::string_view text = urban_nav_core::trimmed(line);
    if (!beginsWith(text, "- ")) is_listing = beginsWith(text, "relative_file_paths");
    else if (is_listing) names.emplace_back(urban_nav_core::trimmed(text.substr(2)));
  });
  return names;
}

/// A folder of rosbag2 whose recording is missing or compressed.
std::optional<ForeignInput> recogniseMetadata(const fs::path& folder) {
  const fs::path metadata = folder / "metadata.yaml";
  if (!fs::exists(metadata) || !holds(readHead(metadata), "rosbag2_bagfile_information")) return std::nullopt;
  for (const std::string& name : listedFiles(metadata)) {
    const std::string path = (folder / name).string();
    if (!fs::exists(path))
      return ForeignInput{
          "is a folder of rosbag2 without its recording: metadata.yaml lists " + name + ", which is not there",
          "the whole folder, with " + name};
    if (fs::path(name).extension() == ".zstd")
      return ForeignInput{"is a folder of rosbag2 whose recording is compressed by zstd",
                          "`zstd -d " + path + "`, then the file itself"};
  }
  return std::nullopt;
}

std::optional<ForeignInput> recogniseFolder(const fs::path& path) {
  if (auto foreign = recogniseMetadata(path)) return foreign;
  std::vector<std::string> bags;
  std::string storage;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (entry.path().extension() == ".bag") bags.push_back(entry.path().string());
    if (entry.path().extension() == ".mcap") storage = "MCAP";
    if (entry.path().extension() == ".db3") storage = "SQLite";
  }
  if (!storage.empty()) return describeRos2Bag(path, storage);
  if (bags.empty()) return std::nullopt;
  std::sort(bags.begin(), bags.end());
  std::string names;
  for (std::size_t i = 0; i < std::min(bags.size(), kNamedBags); ++i) names += (i > 0 ? " " : "") + bags[i];
  return ForeignInput{"is a folder of " + std::to_string(bags.size()) + (bags.size() == 1 ? " bag" : " bags"),
                      "the bags themselves: " + names + (bags.size() > kNamedBags ? " ..." : "")};
}

}  // namespace

std::optional<ForeignInput> recogniseForeignInput(const std::string& path) {
  return fs::is_directory(path) ? recogniseFolder(path) : recogniseFile(path);
}

}  // namespace urban_nav_input
