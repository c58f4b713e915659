// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/recognise.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "recording/foreign_file.hpp"
#include "recording/storage/mcap_records.hpp"
#include "recording/storage/packed_message.hpp"
#include "recording/storage/storage.hpp"
#include "recording/storage/unpacked_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/recording.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;
using urban_nav_core::UserError;

namespace {

constexpr std::size_t kLeadingBytes = 16;  // bytes
constexpr std::string_view kBagMagic("#ROSBAG"), kSqliteMagic("SQLite format 3", 15);

std::string readBeginning(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};
  std::ifstream file(path, std::ios::binary);
  std::string bytes(kLeadingBytes, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool hasSignature(const std::string& bytes, std::string_view signature) {
  return bytes.compare(0, signature.size(), signature) == 0;
}

std::optional<StorageKind> recogniseStorageFolder(const std::string& path) {
  const fs::path about = fs::path(path) / "metadata.yaml";
  std::ifstream file(about);
  for (std::string line; std::getline(file, line);)
    if (line.find("rosbag2_bagfile_information") != std::string::npos) return StorageKind::Rosbag2Folder;
  return listRosbag2Files(path).empty() ? std::nullopt : std::optional<StorageKind>(StorageKind::Rosbag2Folder);
}

[[noreturn]] void throwNotARecording(const std::string& path) {
  constexpr const char* kAllowed = "a ROS 1 bag, MCAP, a .db3 or a folder of rosbag2";
  std::error_code error;
  if (!fs::exists(path, error)) throw UserError(path, "does not exist", kAllowed);
  if (fs::is_directory(path, error)) throw UserError(path, "is a folder without a recording of rosbag2", kAllowed);
  if (!fs::is_regular_file(path, error)) throw UserError(path, "is neither a file nor a folder", kAllowed);
  if (fs::path(path).extension() == ".zstd") throw UserError(path, "is not a recording that zstd compressed", kAllowed);
  if (const auto foreign = recogniseForeignFile(path)) throw UserError(path, foreign->found, foreign->remedy);
  throw UserError(path, "is not a recording", kAllowed);
}

}  // namespace

std::vector<std::string> listRosbag2Files(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string path = entry.path().string(), signature = readBeginning(path);
    const bool may_be = hasSignature(signature, mcap::kMagic) || hasSignature(signature, kSqliteMagic) ||
                        isZstd({reinterpret_cast<const std::uint8_t*>(signature.data()), signature.size()});
    if (may_be && recogniseStorage(path).value_or(StorageKind::Bag) != StorageKind::Bag) files.push_back(path);
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<StorageKind> recogniseStorage(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return recogniseStorageFolder(path);
  const std::string signature = readBeginning(path);
  if (hasSignature(signature, kBagMagic)) return StorageKind::Bag;
  if (hasSignature(signature, mcap::kMagic)) return StorageKind::Mcap;
  if (hasSignature(signature, kSqliteMagic)) return isDb3(path) ? std::optional(StorageKind::Db3) : std::nullopt;
  if (isZstd({reinterpret_cast<const std::uint8_t*>(signature.data()), signature.size()})) {
    const std::string begin = peekZstdFile(path, kLeadingBytes);
    if (hasSignature(begin, kBagMagic) || hasSignature(begin, mcap::kMagic) || hasSignature(begin, kSqliteMagic))
      return StorageKind::Packed;
  }
  return std::nullopt;
}

bool isRecording(const std::string& path) { return recogniseStorage(path).has_value(); }

std::unique_ptr<Storage> openStorage(const std::string& path) {
  const std::optional<StorageKind> kind = recogniseStorage(path);
  if (!kind) throwNotARecording(path);
  switch (*kind) {
    case StorageKind::Bag: return openBagStorage(path);
    case StorageKind::Mcap: return openMcapStorage(path);
    case StorageKind::Db3: return openDb3Storage(path);
    case StorageKind::Rosbag2Folder: return openRosbag2Folder(path);
    case StorageKind::Packed: return openUnpackedStorage(path);
  }
  return nullptr;
}

}  // namespace urban_nav_input
