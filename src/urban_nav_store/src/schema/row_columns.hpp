// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "schema/row.hpp"
#include "urban_nav_store/columns.hpp"

namespace urban_nav_store {

/// Throws UserError naming file, table and key for values that are not finite.
class CheckingColumns : public Columns {
 public:
  CheckingColumns(const Connection& connection, const Table& table) : connection_(connection), table_(table) {}
  bool isValidating() const override { return true; }
  void text(const char* name, std::string& value) override { addKey(name, value); }
  void integer(const char* name, std::int64_t& value) override { addKey(name, std::to_string(value)); }
  void real(const char* name, double& value) override;
  void blob(const char*, std::string&) override { ++columns_; }
  [[noreturn]] void refuse(const std::string& what) const override;

 private:
  void addKey(const char* name, const std::string& value);

  const Connection& connection_;
  const Table& table_;
  std::size_t columns_ = 0;
  std::string key_;
};

/// Binds the values of a checked row and its checksum.
class WritingColumns : public Columns {
 public:
  explicit WritingColumns(RowWriter& writer) : writer_(writer) {}
  void text(const char*, std::string& value) override { writer_.text(value); }
  void integer(const char*, std::int64_t& value) override { writer_.integer(value); }
  void real(const char*, double& value) override { writer_.real(value); }
  void blob(const char*, std::string& value) override { writer_.blob(value); }

 private:
  RowWriter& writer_;
};

/// Reads the current row of a reader. Columns missing in the reader's table keep their values.
class ReadingColumns : public Columns {
 public:
  explicit ReadingColumns(RowReader& reader) : reader_(reader) {}
  bool isReading() const override { return true; }
  bool isValidating() const override { return true; }
  void text(const char* name, std::string& value) override;
  void integer(const char* name, std::int64_t& value) override;
  void real(const char* name, double& value) override;
  void blob(const char* name, std::string& value) override;
  [[noreturn]] void refuse(const std::string& what) const override { reader_.damaged(what); }

 private:
  bool isStored(const char* name);

  RowReader& reader_;
  std::size_t next_ = 0;
};

/// Binds copies of the leading key columns of a row to the parameters of a statement. Must outlive the execution of the
/// statement.
class KeyColumns : public Columns {
 public:
  KeyColumns(Statement& statement, std::size_t keys) : statement_(statement), keys_(keys) {}
  void text(const char*, std::string& value) override;
  void integer(const char*, std::int64_t& value) override;
  void real(const char*, double&) override { ++next_; }
  void blob(const char*, std::string&) override { ++next_; }

 private:
  Statement& statement_;
  std::size_t keys_;
  std::size_t next_ = 0;
};

}  // namespace urban_nav_store
