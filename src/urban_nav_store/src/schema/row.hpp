// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "schema/schema.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_store {

/// The checksum of a row: CRC-32 (ISO 3309) of its columns in their order, each with its type and length, so that no byte can move from
/// one column to the next unseen.
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

/// Fills the parameters of putSql or insertSql column by column, then writes the row. Blobs and texts must live until write().
class RowWriter {
 public:
  /// Opens a transaction if none is open.
  explicit RowWriter(Connection& connection, const std::string& sql);
  ~RowWriter() { statement_.reset(); }
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;

  RowWriter& text(std::string_view value);
  RowWriter& integer(std::int64_t value);
  RowWriter& real(double value);  ///< -0 becomes 0, which is how SQLite keeps it
  RowWriter& blob(std::string_view value);
  RowWriter& pose(const urban_nav_core::Pose& value);  ///< seven columns: x y z qx qy qz qw
  void write();

 private:
  Statement& statement_;
  RowChecksum checksum_;
  int column_ = 0;
};

/// Reads the rows of selectSql column by column, verifying the checksum of each.
class RowReader {
 public:
  RowReader(Connection& connection, const Table& table, const std::string& rest);

  /// For the parameters of `rest`.
  Statement& statement() { return statement_; }
  /// False at the end. Every column of the row before must have been read: its checksum is compared here.
  bool next();

  /// Views live until the next call of next().
  std::string_view text();
  std::int64_t integer();
  double real();
  std::string_view blob();
  urban_nav_core::Pose pose();

  /// DataError: what was read so far of this row is no such thing.
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

/// DataError where `reader`, at its end, has not seen the rows that the tally counts for this session: some are missing.
void verifyTally(const RowReader& reader, const std::string& session);
/// The same for all rows of a session, by their stored checksums alone: for tables that are read row by row.
void verifyTally(Connection& connection, const Table& table, const std::string& session);

/// A value of any column, for code that treats all tables alike.
struct Value {
  ColumnType type = ColumnType::Integer;
  std::int64_t integer = 0;
  double real = 0.0;
  std::string bytes;  ///< text or blob
};
bool operator==(const Value& a, const Value& b);
using Row = std::vector<Value>;
/// The row that `reader` stands at.
Row readRow(RowReader& reader);
void writeRow(RowWriter& writer, const Row& row);
/// "session=3f..., stamp_ns=12": the key of a row, for errors.
std::string printKey(const Table& table, const Row& row);

/// A matrix as little-endian numbers, row by row: the 21 of the upper triangle where it is symmetric to the last bit, else 36. Back: false
/// for any other number of bytes and for what is not finite.
std::string bytesOf(const urban_nav_core::Matrix6d& matrix);
bool matrixOf(std::string_view bytes, urban_nav_core::Matrix6d& matrix);

}  // namespace urban_nav_store
