// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "schema/schema.hpp"

namespace urban_nav_store {

/// Checksum of a row: CRC-32 (ISO 3309) of its columns in order, each with type and length, so that bytes moved between
/// columns are detected.
class RowChecksum {
 public:
  void text(std::string_view value);
  void integer(std::int64_t value);
  void real(double value);
  void blob(std::string_view value);
  std::int64_t value() const;
  void reset() { bytes_.clear(); }

 private:
  std::string bytes_;
};

/// Fills the parameters of putSql or insertSql column by column, then writes the row. Blobs and texts must live until
/// write().
class RowWriter {
 public:
  /// Opens a transaction if none is open.
  explicit RowWriter(Connection& connection, const std::string& sql);
  ~RowWriter() { statement_.reset(); }
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;

  RowWriter& text(std::string_view value);
  RowWriter& integer(std::int64_t value);
  RowWriter& real(double value);  ///< -0 becomes 0, as SQLite stores it
  RowWriter& blob(std::string_view value);
  void write();

 private:
  Statement& statement_;
  RowChecksum checksum_;
  int column_ = 0;
};

/// Reads the rows of selectSql column by column, verifying the checksum of each.
class RowReader {
 public:
  /// `condition`: empty or "WHERE ...". The table must outlive the reader.
  RowReader(Connection& connection, const Table& table, const std::string& condition);

  /// Returns the statement, for binding the parameters of the condition.
  Statement& statement() { return statement_; }
  /// Advances to the next row; false at the end. Compares the checksum of the previous row, all of whose columns must
  /// have been read.
  bool next();

  /// Returned views are valid until next().
  std::string_view text();
  std::int64_t integer();
  double real();
  std::string_view blob();

  /// Throws DataError: the values of this row read so far are invalid.
  [[noreturn]] void damaged(const std::string& what) const;

  std::int64_t rows() const { return rows_; }
  std::int64_t sum() const { return sum_; }
  Connection& connection() const { return statement_.connection(); }
  const Table& table() const { return table_; }

 private:
  void verify();

  const Table& table_;
  Statement statement_;
  RowChecksum checksum_;
  int column_ = 0;
  std::int64_t rows_ = 0, sum_ = 0;
};

/// Throws DataError unless `reader`, at its end, has read exactly the rows that the tally counts for this session.
void verifyTally(const RowReader& reader, const std::string& session);
/// Throws DataError unless the rows of a session are those counted by the tally, according to their stored checksums;
/// for tables that are read row by row.
void verifyTally(Connection& connection, const Table& table, const std::string& session);

/// Throws DataError unless the rows of all sessions are those counted by the tally.
void verifyTally(Connection& connection, const Table& table);

/// Row of any table, for generic code.
using Row = std::vector<Value>;
/// Reads the current row of `reader`.
Row readRow(RowReader& reader);
void writeRow(RowWriter& writer, const Row& row);
/// Returns a row of an earlier version of a table with the initial values of the added columns.
Row completed(const Row& row, const Table& before, const Table& after);
/// Returns the key of a row for errors: "session=3f..., stamp_ns=12".
std::string printKey(const Table& table, const Row& row);

}  // namespace urban_nav_store
