// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/dump.hpp"

#include "dump_tables.hpp"
#include "schema/row.hpp"
#include "sqlite/snapshot.hpp"
#include "store_implementation.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_store/digest.hpp"

namespace urban_nav_store {

namespace {

constexpr std::size_t kDigits = 16;  // digits of a digest

std::string print(const Value& value) {
  switch (value.type) {
    case ColumnType::Text: return "\"" + value.bytes + "\"";
    case ColumnType::Integer: return std::to_string(value.integer);
    case ColumnType::Real: return urban_nav_core::printNumber(value.real);
    case ColumnType::Blob: break;
  }
  return std::to_string(value.bytes.size()) + ":" + sha256(value.bytes).substr(0, kDigits);
}

void dumpTable(Connection& connection, const Table& table, std::string& text) {
  RowReader reader(connection, table, "");
  while (reader.next()) {
    text += table.name;
    for (const Value& value : readRow(reader)) text += " " + print(value);
    text += "\n";
  }
  verifyTally(connection, table);
}

}  // namespace

std::string dumpTables(Connection& connection) {
  const Snapshot snapshot(connection);
  std::string text;
  const int version = schema::version(connection);
  for (const Table* table : schema::tables())
    if (table->since <= version) dumpTable(connection, schema::atVersion(*table, version), text);
  return text;
}

std::string dump(Store& store) {
  Store::Implementation& parts = store.implementation();
  parts.scans.flush();
  parts.inputs.flush();
  return dumpTables(parts.connection);
}

}  // namespace urban_nav_store
