// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/sqlite_file.hpp"

#include <sqlite3.h>

#include <filesystem>
#include <fstream>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

namespace {

/// Returns a path as an URI of SQLite.
std::string toUri(const std::string& path) {
  std::string uri = "file:";
  for (const char letter : std::filesystem::absolute(path).string()) {
    if (letter == '%' || letter == '?' || letter == '#') {
      constexpr const char* kDigits = "0123456789abcdef";
      const auto code = static_cast<unsigned char>(letter);
      uri += {'%', kDigits[code >> 4U], kDigits[code & 15U]};
    } else {
      uri += letter;
    }
  }
  return uri;
}

/// Returns a big-endian number of four bytes.
std::uint64_t bigEndian(const std::string& bytes, std::size_t at) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8U | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

/// Returns the size in the header of a database (sqlite.org/fileformat.html, section 1.3), bytes; 0 if not stated.
std::uint64_t statedSize(const std::string& path) {
  constexpr std::size_t kHeader = 100, kPageSize = 16, kChanges = 24, kPages = 28, kChangesOfPages = 92;  // bytes
  std::string header(kHeader, '\0');
  if (!std::ifstream(path, std::ios::binary).read(header.data(), kHeader)) return 0;
  const std::uint64_t page = bigEndian(header, kPageSize) >> 16U;  // two bytes; 1 means 65536
  if (bigEndian(header, kChanges) != bigEndian(header, kChangesOfPages)) return 0;
  return (page == 1 ? 65536 : page) * bigEndian(header, kPages);
}

bool hasWal(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path + "-wal", error);
  return !error && size > 0;
}

}  // namespace

SqliteFile::SqliteFile(const std::string& path) : path_(path), database_(nullptr, sqlite3_close_v2) {
  const bool has_wal = hasWal(path);
  open(has_wal);
  if (!has_wal) return;
  try {
    Query(*this, "SELECT count(*) FROM sqlite_master").next();
  } catch (const urban_nav_core::DataError&) {
    is_wal_ignored_ = true;
    open(false);
  }
}

void SqliteFile::open(bool with_wal) {
  // Immutable: no locks, -wal or -shm. A -wal is read without locks and, in exclusive mode, without a -shm file.
  const std::string uri = toUri(path_) + (with_wal ? "?mode=ro" : "?mode=ro&immutable=1");
  sqlite3* opened = nullptr;
  const int status = sqlite3_open_v2(uri.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX,
                                     with_wal ? "unix-none" : nullptr);
  database_.reset(opened);
  if (status != SQLITE_OK) fail();
  if (with_wal) {
    int keeps = 1;
    sqlite3_file_control(opened, nullptr, SQLITE_FCNTL_PERSIST_WAL, &keeps);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    sqlite3_exec(opened, "PRAGMA locking_mode=EXCLUSIVE", nullptr, nullptr, nullptr);
  }
  // Also opens a file shorter than stated in its header; nothing is written with this pragma.
  sqlite3_exec(opened, "PRAGMA writable_schema=ON", nullptr, nullptr, nullptr);
  constexpr int kLargestMapping = 0x7fff0000;  // bytes, which SQLite limits anyway
  sqlite3_exec(opened, ("PRAGMA mmap_size=" + std::to_string(kLargestMapping)).c_str(), nullptr, nullptr, nullptr);
}

bool SqliteFile::hasTable(const std::string& name) {
  try {
    Query query(*this, "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = '" + name + "'");
    return query.next();
  } catch (const urban_nav_core::DataError&) {
    return false;
  }
}

std::string SqliteFile::cut() const {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path_, error), stated = statedSize(path_);
  if (error || size >= stated || (hasWal(path_) && !is_wal_ignored_)) return {};
  return "is cut off at byte " + std::to_string(size) + " of " + std::to_string(stated);
}

void SqliteFile::fail() const {
  throw urban_nav_core::DataError(path_, std::string("cannot be read: ") + sqlite3_errmsg(database_.get()), "");
}

SqliteFile::Query::Query(SqliteFile& file, const std::string& sql)
    : file_(file), statement_(nullptr, sqlite3_finalize) {
  sqlite3_stmt* statement = nullptr;
  const int status = sqlite3_prepare_v2(file.database_.get(), sql.c_str(), -1, &statement, nullptr);
  statement_.reset(statement);
  if (status != SQLITE_OK) file_.fail();
}

bool SqliteFile::Query::next() {
  const int status = sqlite3_step(statement_.get());
  if (status != SQLITE_ROW && status != SQLITE_DONE) file_.fail();
  return status == SQLITE_ROW;
}

void SqliteFile::Query::bind(int place, std::int64_t value) { sqlite3_bind_int64(statement_.get(), place, value); }

void SqliteFile::Query::reset() { sqlite3_reset(statement_.get()); }

std::int64_t SqliteFile::Query::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }

std::string SqliteFile::Query::text(int column) const {
  const ByteView view = blob(column);
  return view.size == 0 ? std::string() : std::string(reinterpret_cast<const char*>(view.data), view.size);
}

ByteView SqliteFile::Query::blob(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  return {static_cast<const std::uint8_t*>(data),
          static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

}  // namespace urban_nav_input
