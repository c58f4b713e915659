// SPDX-License-Identifier: BSD-3-Clause
#include "schema/table_access.hpp"

#include "schema/row.hpp"
#include "schema/row_columns.hpp"
#include "schema/schema.hpp"
#include "sqlite/snapshot.hpp"

namespace urban_nav_store {

namespace {

void readInto(const AnyRow& row, RowReader& reader) {
  ReadingColumns columns(reader);
  row.columns(columns);
}

std::string lastKeyName(const Table& table) { return table.columns[table.keys - 1].name; }

/// Returns "WHERE session=? AND camera=?": all key columns but the last.
std::string whereOthers(const Table& table) { return "WHERE " + keySql(table, table.keys - 1); }

}  // namespace

const Table& TableAccess::stored(const Table& table) {
  if (version_ == 0) version_ = schema::version(connection_);
  bool is_whole = true;
  for (const Column& column : table.columns) is_whole = is_whole && column.since <= version_;
  if (is_whole) return table;
  const auto found = earlier_.find(table.name);
  if (found != earlier_.end()) return found->second;
  return earlier_.emplace(table.name, schema::atVersion(table, version_)).first->second;
}

bool TableAccess::has(const Table& table) {
  if (version_ == 0) version_ = schema::version(connection_);
  return table.since <= version_;
}

void TableAccess::put(const Table& table, const AnyRow& row) {
  CheckingColumns check(connection_, table);
  row.columns(check);
  RowWriter writer(connection_, putSql(table));
  WritingColumns columns(writer);
  row.columns(columns);
  writer.write();
}

bool TableAccess::find(const Table& table, const AnyRow& row) {
  if (!has(table)) return false;
  RowReader reader(connection_, stored(table), "WHERE " + keySql(table, table.keys));
  KeyColumns key(reader.statement(), table.keys);
  row.columns(key);
  bool found = false;
  for (; reader.next(); found = true) readInto(row, reader);
  return found;
}

bool TableAccess::findLast(const Table& table, const AnyRow& row) {
  if (!has(table)) return false;
  const std::string others = keySql(table, table.keys - 1), name = lastKeyName(table);
  std::int64_t last = 0;
  {
    Statement statement = connection_.prepare("SELECT " + name + " FROM " + table.name + " WHERE " + others +
                                              " ORDER BY " + name + " DESC LIMIT 1");
    KeyColumns key(statement, table.keys - 1);
    row.columns(key);
    if (!statement.step()) return false;
    last = statement.integer(0);
  }
  bool found = false;
  forEachBetween(table, row, last, last, [&] { found = true; });
  return found;
}

void TableAccess::remove(const Table& table, const AnyRow& row, std::size_t keys) {
  connection_.beginWriting();
  Statement statement = connection_.prepare("DELETE FROM " + table.name + " WHERE " + keySql(table, keys));
  KeyColumns key(statement, keys);
  row.columns(key);
  statement.step();
}

void TableAccess::forEach(const Table& table, const SessionId& session, const AnyRow& row,
                          const std::function<void()>& visit) {
  if (!has(table)) return;
  const Snapshot snapshot(connection_);  // rows and tally
  RowReader reader(connection_, stored(table), "WHERE " + keySql(table, 1));
  reader.statement().bind(0, session);
  while (reader.next()) {
    readInto(row, reader);
    visit();
  }
  verifyTally(reader, session);
}

void TableAccess::forEachBetween(const Table& table, const AnyRow& row, std::int64_t from, std::int64_t to,
                                 const std::function<void()>& visit) {
  if (!has(table)) return;
  const std::string last = lastKeyName(table);
  RowReader reader(connection_, stored(table), whereOthers(table) + " AND " + last + ">=? AND " + last + "<=?");
  KeyColumns key(reader.statement(), table.keys - 1);
  row.columns(key);
  const auto others = static_cast<int>(table.keys) - 1;
  reader.statement().bind(others, from);
  reader.statement().bind(others + 1, to);
  while (reader.next()) {
    readInto(row, reader);
    visit();
  }
}

void TableAccess::forEachRow(const Table& table, const AnyRow& row, const std::function<void()>& visit) {
  if (!has(table)) return;
  RowReader reader(connection_, stored(table), "");
  while (reader.next()) {
    readInto(row, reader);
    visit();
  }
}

std::vector<std::string> TableAccess::secondKeys(const Table& table, const SessionId& session) {
  std::vector<std::string> values;
  if (!has(table)) return values;
  const std::string& name = table.columns[1].name;
  Statement statement = connection_.prepare("SELECT DISTINCT " + name + " FROM " + table.name + " WHERE " +
                                            keySql(table, 1) + " ORDER BY " + name);
  statement.bind(0, session);
  while (statement.step()) values.emplace_back(statement.text(0));
  return values;
}

std::vector<std::int64_t> TableAccess::lastKeys(const Table& table, const AnyRow& row, std::int64_t from,
                                                std::int64_t to) {
  std::vector<std::int64_t> values;
  if (!has(table)) return values;
  const std::string name = lastKeyName(table);
  Statement statement = connection_.prepare("SELECT " + name + " FROM " + table.name + " " + whereOthers(table) +
                                            " AND " + name + ">=? AND " + name + "<=? ORDER BY " + name);
  KeyColumns key(statement, table.keys - 1);
  row.columns(key);
  const auto others = static_cast<int>(table.keys) - 1;
  statement.bind(others, from);
  statement.bind(others + 1, to);
  while (statement.step()) values.push_back(statement.integer(0));
  return values;
}

std::int64_t TableAccess::count(const Table& table, const SessionId& session) {
  Statement statement = connection_.prepare("SELECT count FROM tally WHERE name=? AND session=?");
  statement.bind(0, table.name);
  statement.bind(1, session);
  return statement.step() ? statement.integer(0) : 0;
}

std::size_t TableAccess::sessions(const Table& table) {
  Statement statement = connection_.prepare("SELECT count(*) FROM tally WHERE name=? AND count>0");
  statement.bind(0, table.name);
  return statement.step() ? static_cast<std::size_t>(statement.integer(0)) : 0;
}

void TableAccess::removeSession(const Table& table, const std::string& column, const SessionId& session) {
  Statement statement = connection_.prepare("DELETE FROM " + table.name + " WHERE " + column + "=?");
  statement.bind(0, session);
  statement.step();
}

void TableAccess::forgetEmpty(const SessionId& session) {
  Statement statement = connection_.prepare("DELETE FROM tally WHERE session=? AND count=0");
  statement.bind(0, session);
  statement.step();
}

void TableAccess::verifyOnce(const Table& table, const SessionId& session) {
  if (!has(table) || verified_.count({table.name, session}) > 0) return;
  verifyTally(connection_, table, session);
  verified_.emplace(table.name, session);
}

}  // namespace urban_nav_store
