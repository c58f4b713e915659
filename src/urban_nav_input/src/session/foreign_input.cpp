// SPDX-License-Identifier: BSD-3-Clause
#include "session/foreign_input.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

namespace urban_nav_input {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kSignatureBytes = 16;
constexpr std::string_view kMcap("\x89MCAP", 5), kSqlite("SQLite format 3", 15);
constexpr std::string_view kGzip("\x1f\x8b", 2), kBzip2("BZh", 3),
    kXz("\xfd"
        "7zXZ",
        5),
    kZstd("\x28\xb5\x2f\xfd", 4);
constexpr std::size_t kNamedBags = 3;

std::string readSignature(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(kSignatureBytes, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool beginsWith(const std::string& bytes, std::string_view signature) {
  return bytes.compare(0, signature.size(), signature) == 0;
}

ForeignInput describeRos2Bag(const fs::path& path, const std::string& storage) {
  const fs::path name = path.has_filename() ? path.stem() : path.parent_path().stem();
  return {"is a ROS 2 bag (" + storage + ")", "`rosbags-convert --src " + path.string() + " --dst " + name.string() +
                                                  ".bag` makes a ROS 1 bag of it (Python package rosbags)"};
}

std::optional<ForeignInput> recogniseFile(const fs::path& path) {
  const std::string signature = readSignature(path);
  if (beginsWith(signature, kMcap)) return describeRos2Bag(path, "MCAP");
  if (beginsWith(signature, kSqlite)) {
    if (path.extension() == ".db3") return describeRos2Bag(path, "SQLite");
    return ForeignInput{"is a store, not a recording", "--store " + path.string() + " continues it"};
  }
  const auto compressed = [&](const char* program) {
    return ForeignInput{std::string("is compressed by ") + program,
                        std::string("the bag itself: `") + program + " -d " + path.string() + "`"};
  };
  if (beginsWith(signature, kGzip)) return compressed("gzip");
  if (beginsWith(signature, kBzip2)) return compressed("bzip2");
  if (beginsWith(signature, kXz)) return compressed("xz");
  if (beginsWith(signature, kZstd)) return compressed("zstd");
  return std::nullopt;
}

std::optional<ForeignInput> recogniseFolder(const fs::path& path) {
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
