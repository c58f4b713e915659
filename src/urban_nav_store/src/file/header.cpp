// SPDX-License-Identifier: BSD-3-Clause
#include "file/header.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "schema/schema.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

namespace fs = std::filesystem;
using urban_nav_core::UserError;

namespace {

// SQLite's file format, section 1.3: 100 bytes, numbers big-endian.
constexpr std::size_t kHeaderBytes = 100, kUserVersion = 60, kApplication = 68;
constexpr std::string_view kMagic("SQLite format 3\0", 16);

std::uint32_t bigEndian(const std::array<char, kHeaderBytes>& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

}  // namespace

FileKind fileKind(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return FileKind::Absent;
  if (!fs::is_regular_file(status)) return FileKind::Other;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw UserError(path, "cannot be opened", "a file that can be read");
  std::array<char, kHeaderBytes> bytes{};
  file.read(bytes.data(), kHeaderBytes);
  if (file.gcount() == 0) return FileKind::Absent;
  if (file.gcount() < static_cast<std::streamsize>(kHeaderBytes) ||
      std::string_view(bytes.data(), kMagic.size()) != kMagic)
    return FileKind::Other;
  const std::uint32_t id = bigEndian(bytes, kApplication);
  const bool is_release = id == static_cast<std::uint32_t>(schema::kReleaseId);
  if (id != static_cast<std::uint32_t>(schema::kApplicationId) && !is_release) return FileKind::OtherSqlite;
  if (bigEndian(bytes, kUserVersion) > static_cast<std::uint32_t>(schemaVersion())) return FileKind::NewerStore;
  return is_release ? FileKind::Release : FileKind::Store;
}

std::string resolved(const std::string& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return path;
  const fs::path target = fs::canonical(path, error);
  return error ? path : target.string();
}

void refuseOtherFiles(const std::string& path, Releases releases) {
  switch (fileKind(path)) {
    case FileKind::Absent:
    case FileKind::Store: return;
    case FileKind::Release:
      if (releases == Releases::Allowed) return;
      throw UserError(path,
                      "is a release, which is read by map --localise, info, export, join --onto and release --diff",
                      "a session store of urban_nav");
    case FileKind::NewerStore:
      throw UserError(path, "was written by a newer urban_nav, and was not changed",
                      "schema " + std::to_string(schemaVersion()) + " or older; or a newer urban_nav");
    case FileKind::OtherSqlite:
      throw UserError(path, "is another program's SQLite file, and was not changed",
                      "a session store of urban_nav, or the path of a new file");
    case FileKind::Other: break;
  }
  throw UserError(path, "is not a session store, or its header is damaged; it was not changed",
                  "a session store of urban_nav, or the path of a new file");
}

}  // namespace urban_nav_store
