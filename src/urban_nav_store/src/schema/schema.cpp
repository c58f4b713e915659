// SPDX-License-Identifier: BSD-3-Clause
#include "schema/schema.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "schema/row.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::UserError;

namespace {

/// Version since which blocks of scans (blocks/scan_block.hpp) and features of keyframes have their present encoding;
/// older ones are read.
constexpr int kPresentEncoding = 12;

/// Version since which all tables with a column of bytes are stored by row number: with pages of 1024 bytes, a pose
/// with its covariances does not fit into a page of the index.
constexpr int kBytesByRowNumber = 12;

/// The tables, indexes and triggers of a schema: name and SQL.
using SqlObjects = std::vector<std::pair<std::string, std::string>>;

const char* sqlType(ColumnType type) {
  switch (type) {
    case ColumnType::Text: return "TEXT";
    case ColumnType::Integer: return "INTEGER";
    case ColumnType::Real: return "REAL";
    case ColumnType::Blob: break;
  }
  return "BLOB";
}

std::string columnNames(const Table& table) {
  std::string text;
  for (const Column& column : table.columns) text += column.name + ",";
  return text + "crc";
}

std::string keyNames(const Table& table) {
  std::string text;
  for (std::size_t i = 0; i < table.keys; ++i) text += (i > 0 ? "," : "") + table.columns[i].name;
  return text;
}

/// Returns whether rows are stored by row number with an index, rather than in the index itself, as SQLite recommends
/// for rows of less than a twentieth of a page.
bool isByRowNumber(const Table& table, int version) {
  const bool has_bytes = std::any_of(table.columns.begin(), table.columns.end(),
                                     [](const Column& column) { return column.type == ColumnType::Blob; });
  return table.wide || (has_bytes && version >= kBytesByRowNumber);
}

/// Triggers maintain the number of rows and the sum of checksums of each session, so that a lost page is detected with
/// its rows.
SqlObjects sqlObjects(const Table& table, int version) {
  const std::string name = table.name, session = table.columns.front().name;
  std::string columns;
  for (const Column& column : table.columns) columns += column.name + " " + sqlType(column.type) + " NOT NULL,";
  const std::string counted = " WHERE name='" + name + "' AND session=";
  return {
      {name, "CREATE TABLE " + name + "(crc INTEGER NOT NULL," + columns + "PRIMARY KEY(" + keyNames(table) + "))" +
                 (isByRowNumber(table, version) ? "" : " WITHOUT ROWID")},
      {name + "_in", "CREATE TRIGGER " + name + "_in AFTER INSERT ON " + name + " BEGIN INSERT INTO tally VALUES('" +
                         name + "',new." + session +
                         ",1,new.crc) ON CONFLICT(name,session) DO UPDATE SET count=count+1,sum=sum+excluded.sum; END"},
      {name + "_out", "CREATE TRIGGER " + name + "_out AFTER DELETE ON " + name +
                          " BEGIN UPDATE tally SET count=count-1,sum=sum-old.crc" + counted + "old." + session +
                          "; END"},
      {name + "_new", "CREATE TRIGGER " + name + "_new AFTER UPDATE ON " + name +
                          " BEGIN UPDATE tally SET sum=sum-old.crc+new.crc" + counted + "new." + session + "; END"}};
}

SqlObjects sqlObjects(const Tables& tables, int version) {
  SqlObjects objects = {
      {"tally",
       "CREATE TABLE tally(name TEXT NOT NULL,session TEXT NOT NULL,count INTEGER NOT NULL,sum INTEGER NOT NULL,"
       "PRIMARY KEY(name,session)) WITHOUT ROWID"}};
  for (const Table* table : tables)
    if (table->since <= version)
      for (auto& object : sqlObjects(schema::atVersion(*table, version), version)) objects.push_back(std::move(object));
  return objects;
}

void createTable(Connection& connection, const Table& table, int version) {
  for (const auto& [name, sql] : sqlObjects(table, version)) connection.execute(sql);
}

/// Rewrites the rows of a table with the added columns, in the layout of a version.
void rewrite(Connection& connection, const Table& before, const Table& after, int version) {
  const std::string name = before.name;
  verifyTally(connection, before);
  for (const char* trigger : {"_in", "_out", "_new"}) connection.execute("DROP TRIGGER " + name + trigger);
  connection.execute("DELETE FROM tally WHERE name='" + name + "'");
  Table source = before;
  source.name = name + "_before";
  connection.execute("ALTER TABLE " + name + " RENAME TO " + source.name);
  createTable(connection, after, version);
  {
    RowReader reader(connection, source, "");
    while (reader.next()) {
      RowWriter writer(connection, insertSql(after));
      writeRow(writer, completed(readRow(reader), before, after));
    }
  }
  connection.execute("DROP TABLE " + source.name);
}

}  // namespace

namespace schema {

int latestVersion(const Tables& tables) {
  int latest = kPresentEncoding;
  for (const Table* table : tables) {
    latest = std::max(latest, table->since);
    for (const Column& column : table->columns) latest = std::max(latest, column.since);
  }
  return latest;
}

int version(Connection& connection) { return static_cast<int>(connection.integer("PRAGMA user_version")); }

Table atVersion(const Table& table, int version) {
  Table then = table;
  then.columns.erase(std::remove_if(then.columns.begin(), then.columns.end(),
                                    [&](const Column& column) { return column.since > version; }),
                     then.columns.end());
  return then;
}

void create(Connection& connection, const Tables& tables, int version) {
  std::string sql = "BEGIN IMMEDIATE;";
  for (const auto& [name, text] : sqlObjects(tables, version)) sql += text + ";";
  sql += "PRAGMA application_id=" + std::to_string(kApplicationId) + ";PRAGMA user_version=" + std::to_string(version) +
         ";COMMIT";
  connection.execute(sql);
}

void migrate(Connection& connection, const Tables& tables) {
  const int from = version(connection), latest = latestVersion(tables);
  if (from >= latest) return;
  connection.beginWriting();
  for (const Table* table : tables) {
    const Table before = atVersion(*table, from), after = atVersion(*table, latest);
    if (table->since > from) {
      createTable(connection, after, latest);
    } else if (before.columns.size() < after.columns.size() ||
               isByRowNumber(before, from) != isByRowNumber(after, latest)) {
      rewrite(connection, before, after, latest);
    }
  }
  connection.execute("PRAGMA user_version=" + std::to_string(latest));
  connection.commit();
}

void check(Connection& connection, const Tables& tables) {
  if (const std::int64_t id = connection.integer("PRAGMA application_id"); id != kApplicationId && id != kReleaseId)
    throw UserError(connection.name(), "is another program's SQLite file, and was not changed",
                    "a session store of urban_nav, or the path of a new file");
  const int found_version = version(connection), latest = latestVersion(tables);
  if (found_version > latest)
    throw UserError(
        connection.name(),
        "was written by a newer urban_nav (schema " + std::to_string(found_version) + "), and was not changed",
        "schema " + std::to_string(latest) + " or older; or a newer urban_nav");
  if (found_version < 1) connection.damaged("schema " + std::to_string(found_version) + " does not exist");
  std::map<std::string, std::string> found;
  Statement statement = connection.prepare("SELECT name,sql FROM sqlite_master WHERE sql IS NOT NULL");
  while (statement.step()) found[std::string(statement.text(0))] = statement.text(1);
  for (const auto& [name, text] : sqlObjects(tables, found_version)) {
    const auto object = found.find(name);
    if (object == found.end() || object->second != text)
      connection.damaged("table " + name + " has a different schema");
  }
}

}  // namespace schema

std::string insertSql(const Table& table) {
  std::string marks = "?";
  for (std::size_t i = 0; i < table.columns.size(); ++i) marks += ",?";
  return "INSERT INTO " + table.name + "(" + columnNames(table) + ") VALUES(" + marks + ")";
}

std::string putSql(const Table& table) {
  std::string sets;
  for (std::size_t i = table.keys; i < table.columns.size(); ++i) {
    const std::string& name = table.columns[i].name;
    sets += name + "=excluded." + name + ",";
  }
  return insertSql(table) + " ON CONFLICT(" + keyNames(table) + ") DO UPDATE SET " + sets + "crc=excluded.crc";
}

std::string selectSql(const Table& table, const std::string& condition) {
  return "SELECT " + columnNames(table) + " FROM " + table.name + (condition.empty() ? "" : " " + condition) +
         " ORDER BY " + keyNames(table);
}

std::string keySql(const Table& table, std::size_t keys) {
  std::string text;
  for (std::size_t i = 0; i < keys; ++i) text += (i > 0 ? " AND " : "") + table.columns[i].name + "=?";
  return text;
}

}  // namespace urban_nav_store
