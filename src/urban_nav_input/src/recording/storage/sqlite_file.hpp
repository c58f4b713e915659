// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "urban_nav_input/recording/byte_view.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace urban_nav_input {

/// SQLite database opened read-only: neither it nor its folder is changed in any journal mode; its -wal is read too.
/// Does not lock it, hence does not wait for concurrent writers. Throws DataError naming the file. Not thread-safe.
class SqliteFile {
 public:
  explicit SqliteFile(const std::string& path);

  /// Returns whether there is a table of this name; false also if the file is not a database.
  bool hasTable(const std::string& name);
  const std::string& path() const { return path_; }
  /// Returns whether there is an unreadable -wal, whose content is missing.
  bool isWalIgnored() const { return is_wal_ignored_; }
  /// Returns where the file is truncated, by the size in its header; empty if it is complete.
  std::string cut() const;

  /// Statement with iteration over its rows.
  class Query {
   public:
    Query(SqliteFile& file, const std::string& sql);
    /// Moves to the next row; false at the end.
    bool next();
    void bind(int place, std::int64_t value);
    void reset();
    std::int64_t integer(int column) const;
    std::string text(int column) const;
    /// Returns bytes that are valid until the next row.
    ByteView blob(int column) const;

   private:
    SqliteFile& file_;
    std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement_;
  };

 private:
  void open(bool with_wal);
  [[noreturn]] void fail() const;

  std::string path_;
  bool is_wal_ignored_ = false;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> database_;
};

}  // namespace urban_nav_input
