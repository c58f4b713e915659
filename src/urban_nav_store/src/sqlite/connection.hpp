// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <unordered_map>

#include "sqlite/statement.hpp"

struct sqlite3;

namespace urban_nav_store {

/// Connection to an SQLite file. Errors of SQLite become UserError or DataError naming the file (errors.hpp). Not
/// thread-safe.
class Connection {
 public:
  enum class Mode {
    Read,        ///< with the content of the log; a writer may be active
    ReadFrozen,  ///< the file only; auxiliary files are neither read nor created
    Write,
    Create,
  };
  /// `name`: file named in errors, if it is created under another one.
  Connection(const std::string& path, Mode mode, std::string name = "");
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  const std::string& name() const { return name_; }

  /// Executes statements that return no rows.
  void execute(const std::string& sql);
  /// Returns a separate statement, for iteration.
  Statement prepare(const std::string& sql);
  /// Returns a statement that is cached by its text, for single rows.
  Statement& cached(const std::string& sql);
  std::int64_t integer(const std::string& sql);

  /// Opens a transaction if none is open. Throws UserError if the store was opened for reading.
  void beginWriting();
  bool inTransaction() const;
  bool writes() const { return writes_; }
  void commit();
  void rollback();
  /// Ends the transaction of a reader, if one is open; never throws.
  void endReading() noexcept;

  /// Closes the file; any later call throws UserError.
  void close();

  sqlite3* handle() const;
  /// Rolls back uncommitted writes and throws the error of `code`.
  [[noreturn]] void fail(int code) const;
  /// Throws DataError: the file is damaged; `what` states where.
  [[noreturn]] void damaged(const std::string& what) const;

 private:
  std::string name_;
  bool writes_;
  sqlite3* handle_ = nullptr;
  std::unordered_map<std::string, Statement> cached_;
};

}  // namespace urban_nav_store
