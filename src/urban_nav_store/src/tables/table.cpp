// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

namespace {

/// Records names, types and initial values of columns.
class DeclaringColumns : public Columns {
 public:
  explicit DeclaringColumns(Table& table) : table_(table), since_(table.since) {}

  void since(int version) override { since_ = version; }
  void text(const char* name, std::string& value) override { add(name, {ColumnType::Text, 0, 0.0, value}); }
  void integer(const char* name, std::int64_t& value) override { add(name, {ColumnType::Integer, value, 0.0, ""}); }
  void real(const char* name, double& value) override { add(name, {ColumnType::Real, 0, value, ""}); }
  void blob(const char* name, std::string& value) override { add(name, {ColumnType::Blob, 0, 0.0, value}); }

 private:
  void add(const char* name, Value initial) {
    const ColumnType type = initial.type;
    table_.columns.push_back({name, type, since_, std::move(initial)});
  }

  Table& table_;
  int since_;
};

}  // namespace

Table withColumns(Table table, const std::function<void(Columns&)>& visit) {
  DeclaringColumns columns(table);
  visit(columns);
  return table;
}

}  // namespace urban_nav_store
