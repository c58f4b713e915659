// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <unordered_map>

#include "sqlite/statement.hpp"

struct sqlite3;

namespace urban_nav_store {

/// One connection to one SQLite file. Whatever SQLite reports becomes a UserError or DataError that names the file
/// (errors.hpp). Not thread-safe.
class Connection {
 public:
  enum class Mode {
    Read,        ///< with what stands in the log beside the file; a writer may be at work
    ReadFrozen,  ///< the file alone, nothing beside it is looked at or made
    Write,
    Create,
  };
  /// `name`: the file in errors, where it is made under another one.
  Connection(const std::string& path, Mode mode, std::string name = "");
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  const std::string& name() const { return name_; }

  /// Runs statements that give no rows.
  void execute(const std::string& sql);
  /// A statement of one's own, to iterate with.
  Statement prepare(const std::string& sql);
  /// A statement that is kept for the next call with the same text: for one row at a time.
  Statement& cached(const std::string& sql);
  std::int64_t integer(const std::string& sql);

  /// Opens a transaction if none is open. UserError where the store was opened for reading.
  void beginWriting();
  bool inTransaction() const;
  bool writes() const { return writes_; }
  void commit();
  void rollback();
  /// Ends the transaction of a reader, if one is open; never throws.
  void endReading() noexcept;

  /// Closes the file; everything after it is a UserError.
  void close();

  sqlite3* handle() const;
  /// Takes back what was not committed, and throws what `code` stands for.
  [[noreturn]] void fail(int code) const;
  /// DataError: the file is damaged, `what` says where.
  [[noreturn]] void damaged(const std::string& what) const;

 private:
  std::string name_;
  bool writes_;
  sqlite3* handle_ = nullptr;
  std::unordered_map<std::string, Statement> cached_;
};

}  // namespace urban_nav_store
