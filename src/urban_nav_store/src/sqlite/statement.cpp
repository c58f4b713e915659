// SPDX-License-Identifier: BSD-3-Clause
#include "sqlite/statement.hpp"

#include <sqlite3.h>

#include <utility>

#include "sqlite/connection.hpp"

namespace urban_nav_store {

Statement::Statement(Connection& connection, const std::string& sql) : connection_(&connection) {
  const int code =
      sqlite3_prepare_v2(connection.handle(), sql.c_str(), static_cast<int>(sql.size()) + 1, &statement_, nullptr);
  if (code != SQLITE_OK) connection.fail(code);
}

Statement::~Statement() { sqlite3_finalize(statement_); }

Statement::Statement(Statement&& other) noexcept
    : connection_(other.connection_), statement_(std::exchange(other.statement_, nullptr)) {}

void Statement::bind(int parameter, std::string_view text) {
  const int code = sqlite3_bind_text64(statement_, parameter + 1, text.empty() ? "" : text.data(), text.size(),
                                       SQLITE_STATIC, SQLITE_UTF8);
  if (code != SQLITE_OK) connection_->fail(code);
}

void Statement::bind(int parameter, std::int64_t value) {
  const int code = sqlite3_bind_int64(statement_, parameter + 1, value);
  if (code != SQLITE_OK) connection_->fail(code);
}

void Statement::bind(int parameter, double value) {
  const int code = sqlite3_bind_double(statement_, parameter + 1, value);
  if (code != SQLITE_OK) connection_->fail(code);
}

void Statement::bindBlob(int parameter, std::string_view bytes) {
  const int code =
      sqlite3_bind_blob64(statement_, parameter + 1, bytes.empty() ? "" : bytes.data(), bytes.size(), SQLITE_STATIC);
  if (code != SQLITE_OK) connection_->fail(code);
}

bool Statement::step() {
  connection_->handle();  // throws if it is closed
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  sqlite3_reset(statement_);
  if (code != SQLITE_DONE) connection_->fail(code);
  return false;
}

void Statement::reset() { sqlite3_reset(statement_); }

int Statement::columns() const { return sqlite3_column_count(statement_); }

void Statement::expect(int column, int type) const {
  const int found = sqlite3_column_type(statement_, column);
  if (found != type)
    connection_->damaged("column " + std::string(sqlite3_column_name(statement_, column)) + " holds another type");
}

std::string_view Statement::text(int column) const {
  expect(column, SQLITE_TEXT);
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  if (bytes == nullptr) connection_->fail(SQLITE_NOMEM);
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}

std::string_view Statement::blob(int column) const {
  expect(column, SQLITE_BLOB);
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_, column));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, column));
  if (bytes == nullptr && size > 0) connection_->fail(SQLITE_NOMEM);
  return {bytes, size};
}

std::int64_t Statement::integer(int column) const {
  expect(column, SQLITE_INTEGER);
  return sqlite3_column_int64(statement_, column);
}

double Statement::real(int column) const {
  expect(column, SQLITE_FLOAT);
  return sqlite3_column_double(statement_, column);
}

}  // namespace urban_nav_store
