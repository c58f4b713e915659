// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

struct sqlite3_stmt;

namespace urban_nav_store {

class Connection;

/// A prepared statement. Parameters and columns count from 0. The connection must outlive it.
class Statement {
 public:
  Statement(Connection& connection, const std::string& sql);
  ~Statement();
  Statement(Statement&& other) noexcept;
  Statement& operator=(Statement&&) = delete;

  /// The text must live until the statement is reset.
  void bind(int parameter, std::string_view text);
  void bind(int parameter, std::int64_t value);
  void bind(int parameter, double value);
  void bindBlob(int parameter, std::string_view bytes);

  /// Advances to the next row; false at the end, after which the statement can be executed again.
  bool step();
  void reset();

  int columns() const;
  /// Throws DataError (a damaged file) if the column has another type.
  std::string_view text(int column) const;
  std::string_view blob(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;

  Connection& connection() const { return *connection_; }

 private:
  void expect(int column, int type) const;

  Connection* connection_;
  sqlite3_stmt* statement_ = nullptr;
};

/// Resets a cached statement at the end of a scope.
class ResetAtEnd {
 public:
  explicit ResetAtEnd(Statement& statement) : statement_(statement) {}
  ~ResetAtEnd() { statement_.reset(); }
  ResetAtEnd(const ResetAtEnd&) = delete;
  ResetAtEnd& operator=(const ResetAtEnd&) = delete;

 private:
  Statement& statement_;
};

}  // namespace urban_nav_store
