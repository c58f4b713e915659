// SPDX-License-Identifier: BSD-3-Clause
#include "schema/row.hpp"

#include <zlib.h>

#include <cmath>

#include "sqlite/snapshot.hpp"
#include "urban_nav_store/bytes.hpp"

namespace urban_nav_store {

void RowChecksum::text(std::string_view value) {
  bytes_ += 't';
  appendInteger(bytes_, static_cast<std::uint64_t>(value.size()));
  bytes_ += value;
}
void RowChecksum::integer(std::int64_t value) {
  bytes_ += 'i';
  appendInteger(bytes_, static_cast<std::uint64_t>(value));
}
void RowChecksum::real(double value) {
  bytes_ += 'r';
  appendNumber(bytes_, value);
}
void RowChecksum::blob(std::string_view value) {
  bytes_ += 'b';
  appendInteger(bytes_, static_cast<std::uint64_t>(value.size()));
  bytes_ += value;
}
std::int64_t RowChecksum::value() const {
  return static_cast<std::int64_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes_.data()), bytes_.size()));
}

RowWriter::RowWriter(Connection& connection, const std::string& sql)
    : statement_((connection.beginWriting(), connection.cached(sql))) {}

RowWriter& RowWriter::text(std::string_view value) {
  statement_.bind(column_++, value);
  checksum_.text(value);
  return *this;
}
RowWriter& RowWriter::integer(std::int64_t value) {
  statement_.bind(column_++, value);
  checksum_.integer(value);
  return *this;
}
RowWriter& RowWriter::real(double value) {
  const double kept = value == 0.0 ? 0.0 : value;
  statement_.bind(column_++, kept);
  checksum_.real(kept);
  return *this;
}
RowWriter& RowWriter::blob(std::string_view value) {
  statement_.bindBlob(column_++, value);
  checksum_.blob(value);
  return *this;
}
void RowWriter::write() {
  statement_.bind(column_, checksum_.value());
  statement_.step();
}

RowReader::RowReader(Connection& connection, const Table& table, const std::string& condition)
    : table_(table), statement_(connection.prepare(selectSql(table, condition))) {}

void RowReader::verify() {
  if (column_ == 0) return;
  const std::int64_t stored = statement_.integer(column_);
  if (stored != checksum_.value()) damaged("its checksum does not match");
  ++rows_;
  sum_ += stored;
}

bool RowReader::next() {
  verify();
  checksum_.reset();
  column_ = 0;
  return statement_.step();
}

std::string_view RowReader::text() {
  const std::string_view value = statement_.text(column_++);
  checksum_.text(value);
  return value;
}
std::int64_t RowReader::integer() {
  const std::int64_t value = statement_.integer(column_++);
  checksum_.integer(value);
  return value;
}
double RowReader::real() {
  const double value = statement_.real(column_++);
  if (!std::isfinite(value)) damaged("a number is not finite");
  checksum_.real(value);
  return value;
}
std::string_view RowReader::blob() {
  const std::string_view value = statement_.blob(column_++);
  checksum_.blob(value);
  return value;
}
void RowReader::damaged(const std::string& what) const {
  statement_.connection().damaged("in table " + table_.name + ", " + what);
}

namespace {

void compareWithTally(Connection& connection, const Table& table, const std::string& session, std::int64_t rows,
                      std::int64_t sum) {
  Statement& statement = connection.cached("SELECT count,sum FROM tally WHERE name=? AND session=?");
  const ResetAtEnd reset(statement);
  statement.bind(0, table.name);
  statement.bind(1, session);
  const bool known = statement.step();
  const std::int64_t count = known ? statement.integer(0) : 0;
  if (count != rows || (known ? statement.integer(1) : 0) != sum)
    connection.damaged("in table " + table.name + ", session " + session + " has " + std::to_string(rows) +
                       " rows that do not match the " + std::to_string(count) + " written");
}

}  // namespace

void verifyTally(const RowReader& reader, const std::string& session) {
  compareWithTally(reader.connection(), reader.table(), session, reader.rows(), reader.sum());
}

void verifyTally(Connection& connection, const Table& table, const std::string& session) {
  const Snapshot snapshot(connection);
  Statement statement = connection.prepare("SELECT count(*),ifnull(sum(crc),0) FROM " + table.name + " WHERE " +
                                           table.columns.front().name + "=?");
  statement.bind(0, session);
  if (statement.step()) compareWithTally(connection, table, session, statement.integer(0), statement.integer(1));
}

bool operator==(const Value& a, const Value& b) {
  return a.type == b.type && a.integer == b.integer && a.real == b.real && a.bytes == b.bytes;
}

void verifyTally(Connection& connection, const Table& table) {
  const Snapshot snapshot(connection);
  std::vector<std::string> sessions;
  {
    Statement statement = connection.prepare("SELECT session FROM tally WHERE name=? AND count<>0 UNION SELECT " +
                                             table.columns.front().name + " FROM " + table.name);
    statement.bind(0, table.name);
    while (statement.step()) sessions.emplace_back(statement.text(0));
  }
  for (const std::string& session : sessions) verifyTally(connection, table, session);
}

Row readRow(RowReader& reader) {
  Row row;
  for (const Column& column : reader.table().columns) {
    Value value;
    value.type = column.type;
    switch (column.type) {
      case ColumnType::Text: value.bytes = reader.text(); break;
      case ColumnType::Integer: value.integer = reader.integer(); break;
      case ColumnType::Real: value.real = reader.real(); break;
      case ColumnType::Blob: value.bytes = reader.blob(); break;
    }
    row.push_back(std::move(value));
  }
  return row;
}

void writeRow(RowWriter& writer, const Row& row) {
  for (const Value& value : row) {
    switch (value.type) {
      case ColumnType::Text: writer.text(value.bytes); break;
      case ColumnType::Integer: writer.integer(value.integer); break;
      case ColumnType::Real: writer.real(value.real); break;
      case ColumnType::Blob: writer.blob(value.bytes); break;
    }
  }
  writer.write();
}

Row completed(const Row& row, const Table& before, const Table& after) {
  Row complete;
  std::size_t next = 0;
  for (const Column& column : after.columns) {
    const bool is_old = next < before.columns.size() && before.columns[next].name == column.name;
    complete.push_back(is_old ? row[next++] : column.initial);
  }
  return complete;
}

std::string printKey(const Table& table, const Row& row) {
  std::string text;
  for (std::size_t i = 0; i < table.keys; ++i) {
    const Value& value = row[i];
    text += (i > 0 ? ", " : "") + table.columns[i].name + "=" +
            (value.type == ColumnType::Integer ? std::to_string(value.integer) : value.bytes);
  }
  return text;
}

}  // namespace urban_nav_store
