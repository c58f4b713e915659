// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sqlite/connection.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Reads and writes rows of all tables of one connection. A file older than a table has no rows of it; columns newer
/// than the file have their initial values. Not thread-safe.
class TableAccess {
 public:
  /// The connection must outlive this object.
  explicit TableAccess(Connection& connection) : connection_(connection) {}

  Connection& connection() const { return connection_; }
  /// Returns false in a file that is older than the table.
  bool has(const Table& table);

  /// Writes a row, replacing one with the same key. Throws UserError naming the row if a value is not finite.
  void put(const Table& table, const AnyRow& row);
  /// Reads the row with the key columns of `row` into it. Returns false, without effect, if there is none.
  bool find(const Table& table, const AnyRow& row);
  /// Reads the row with the greatest last key among those with the other key columns of `row`.
  bool findLast(const Table& table, const AnyRow& row);
  /// Removes the rows whose first `keys` key columns are those of `key`.
  void remove(const Table& table, const AnyRow& key, std::size_t keys);

  /// Calls `visit` after reading each row of a session into `row`, in the order of the keys. Throws DataError at the
  /// end if a row is missing.
  void forEach(const Table& table, const SessionId& session, const AnyRow& row, const std::function<void()>& visit);
  /// Calls `visit` after reading each row whose last key, an integer, is in from...to and whose other keys are those of
  /// `row`.
  void forEachBetween(const Table& table, const AnyRow& row, std::int64_t from, std::int64_t to,
                      const std::function<void()>& visit);
  /// Calls `visit` after reading each row of the table.
  void forEachRow(const Table& table, const AnyRow& row, const std::function<void()>& visit);

  /// Returns the distinct values of the second key column, a text, in a session; sorted.
  std::vector<std::string> secondKeys(const Table& table, const SessionId& session);
  /// Returns the values of the last key column, an integer, of the rows with the other key columns of `row`; ascending,
  /// from...to. Reads no other column.
  std::vector<std::int64_t> lastKeys(const Table& table, const AnyRow& row,
                                     std::int64_t from = std::numeric_limits<std::int64_t>::min(),
                                     std::int64_t to = std::numeric_limits<std::int64_t>::max());
  /// Returns the number of rows that a session has according to the tally.
  std::int64_t count(const Table& table, const SessionId& session);
  /// Returns the number of sessions that have rows of the table according to the tally.
  std::size_t sessions(const Table& table);

  /// Removes the rows whose column `column` refers to the session.
  void removeSession(const Table& table, const std::string& column, const SessionId& session);
  /// Removes the entries of the tally without rows of a session.
  void forgetEmpty(const SessionId& session);

  /// Throws DataError if a session's rows are not those that were written. Verifies each session once: later writes
  /// through this object cannot be lost undetected.
  void verifyOnce(const Table& table, const SessionId& session);

 private:
  /// Returns the table with the columns of the file.
  const Table& stored(const Table& table);

  Connection& connection_;
  int version_ = 0;                       // of the file; 0: unknown
  std::map<std::string, Table> earlier_;  // tables with fewer columns in this file, by name
  std::set<std::pair<std::string, SessionId>> verified_;
};

}  // namespace urban_nav_store
