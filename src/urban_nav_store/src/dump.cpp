// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/dump.hpp"

#include <set>

#include "dump_tables.hpp"
#include "schema/row.hpp"
#include "store_implementation.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_store/digest.hpp"

namespace urban_nav_store {

namespace {

constexpr std::size_t kDigits = 16;  // of a digest

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
  std::set<std::string> sessions;
  RowReader reader(connection, table, "");
  while (reader.next()) {
    const Row row = readRow(reader);
    sessions.insert(row.front().bytes);
    text += table.name;
    for (const Value& value : row) text += " " + print(value);
    text += "\n";
  }
  // Of each session that has rows here by the tally, all must be there.
  Statement statement = connection.prepare("SELECT session FROM tally WHERE name=? AND count<>0");
  statement.bind(0, std::string_view(table.name));
  while (statement.step()) sessions.insert(std::string(statement.text(0)));
  for (const std::string& session : sessions) verifyTally(connection, table, session);
}

}  // namespace

std::string dumpTables(Connection& connection) {
  std::string text;
  for (const Table* table : schema::tables())
    if (schema::has(connection, *table)) dumpTable(connection, *table, text);
  return text;
}

std::string dump(Store& store) {
  Store::Implementation& parts = store.implementation();
  parts.scans.flush();
  parts.inputs.flush();
  return dumpTables(parts.connection);
}

}  // namespace urban_nav_store
