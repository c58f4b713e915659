// SPDX-License-Identifier: BSD-3-Clause
#include "schema/schema.hpp"

#include <map>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

using urban_nav_core::UserError;

namespace {

constexpr ColumnType T = ColumnType::Text, I = ColumnType::Integer, R = ColumnType::Real, B = ColumnType::Blob;

const char* sqlOf(ColumnType type) {
  switch (type) {
    case ColumnType::Text: return "TEXT";
    case ColumnType::Integer: return "INTEGER";
    case ColumnType::Real: return "REAL";
    case ColumnType::Blob: break;
  }
  return "BLOB";
}

/// Wide rows live by row number with an index, narrow ones in the index itself: SQLite's own advice for tables without row numbers.
bool isWide(const Table& table) {
  return &table == &schema::evidence() || &table == &schema::scan() || &table == &schema::keyframe() ||
         &table == &schema::input() || &table == &schema::state();
}

std::string columnNames(const Table& table) {
  std::string text;
  for (const Column& column : table.columns) text += std::string(column.name) + ",";
  return text + "crc";
}

std::string keyNames(const Table& table) {
  std::string text;
  for (int i = 0; i < table.keys; ++i)
    text += (i > 0 ? "," : "") + std::string(table.columns[static_cast<std::size_t>(i)].name);
  return text;
}

/// Triggers keep rows and the sum of checksums of each session, so that a page that was lost with its rows is missed.
std::vector<std::pair<std::string, std::string>> objectsOf(const Table& table) {
  const std::string name = table.name, session = table.columns.front().name;
  std::string columns;
  for (const Column& column : table.columns)
    columns += std::string(column.name) + " " + sqlOf(column.type) + " NOT NULL,";
  const std::string mine = " WHERE name='" + name + "' AND session=";
  return {
      {name, "CREATE TABLE " + name + "(crc INTEGER NOT NULL," + columns + "PRIMARY KEY(" + keyNames(table) + "))" +
                 (isWide(table) ? "" : " WITHOUT ROWID")},
      {name + "_in", "CREATE TRIGGER " + name + "_in AFTER INSERT ON " + name + " BEGIN INSERT INTO tally VALUES('" +
                         name + "',new." + session +
                         ",1,new.crc) ON CONFLICT(name,session) DO UPDATE SET count=count+1,sum=sum+excluded.sum; END"},
      {name + "_out", "CREATE TRIGGER " + name + "_out AFTER DELETE ON " + name +
                          " BEGIN UPDATE tally SET count=count-1,sum=sum-old.crc" + mine + "old." + session + "; END"},
      {name + "_new", "CREATE TRIGGER " + name + "_new AFTER UPDATE ON " + name +
                          " BEGIN UPDATE tally SET sum=sum-old.crc+new.crc" + mine + "new." + session + "; END"}};
}

std::vector<std::pair<std::string, std::string>> allObjects(std::int64_t version) {
  std::vector<std::pair<std::string, std::string>> objects = {
      {"tally",
       "CREATE TABLE tally(name TEXT NOT NULL,session TEXT NOT NULL,count INTEGER NOT NULL,sum INTEGER NOT NULL,"
       "PRIMARY KEY(name,session)) WITHOUT ROWID"}};
  for (const Table* table : schema::tables())
    if (table->since <= version)
      for (auto& object : objectsOf(*table)) objects.push_back(std::move(object));
  return objects;
}

}  // namespace

namespace schema {

const Table& session() {
  static const Table table{
      "session", 1, {{"id", T}, {"name", T}, {"robot", T}, {"recording", T}, {"start_ns", I}, {"complete", I}}};
  return table;
}
const Table& anchor() {
  static const Table table{"anchor",
                           1,
                           {{"session", T},
                            {"map", T},
                            {"revision", I},
                            {"x", R},
                            {"y", R},
                            {"z", R},
                            {"qx", R},
                            {"qy", R},
                            {"qz", R},
                            {"qw", R}}};
  return table;
}
const Table& parameter() {
  static const Table table{"parameter", 2, {{"session", T}, {"name", T}, {"value", T}, {"origin", T}}};
  return table;
}
const Table& property() {
  static const Table table{"property", 2, {{"session", T}, {"name", T}, {"value", T}}};
  return table;
}
const Table& extrinsic() {
  static const Table table{
      "extrinsic",
      2,
      {{"session", T}, {"frame", T}, {"x", R}, {"y", R}, {"z", R}, {"qx", R}, {"qy", R}, {"qz", R}, {"qw", R}}};
  return table;
}
const Table& node() {
  static const Table table{"node",
                           2,
                           {{"session", T},
                            {"stamp_ns", I},
                            {"x", R},
                            {"y", R},
                            {"z", R},
                            {"qx", R},
                            {"qy", R},
                            {"qz", R},
                            {"qw", R},
                            {"status", T},
                            {"covariance", B},
                            {"drift", B}}};
  return table;
}
const Table& relaxed() {
  static const Table table{"relaxed",
                           2,
                           {{"session", T},
                            {"stamp_ns", I},
                            {"x", R},
                            {"y", R},
                            {"z", R},
                            {"qx", R},
                            {"qy", R},
                            {"qz", R},
                            {"qw", R},
                            {"revision", I}}};
  return table;
}
const Table& edge() {
  static const Table table{"edge",
                           6,
                           {{"session_a", T},
                            {"stamp_a_ns", I},
                            {"session_b", T},
                            {"stamp_b_ns", I},
                            {"kind", T},
                            {"source", T},
                            {"x", R},
                            {"y", R},
                            {"z", R},
                            {"qx", R},
                            {"qy", R},
                            {"qz", R},
                            {"qw", R},
                            {"information", B},
                            {"weight", R},
                            {"verdict", T},
                            {"reason", T}}};
  return table;
}
const Table& evidence() {
  static const Table table{"evidence",
                           6,
                           {{"session_a", T},
                            {"stamp_a_ns", I},
                            {"session_b", T},
                            {"stamp_b_ns", I},
                            {"kind", T},
                            {"source", T},
                            {"data", B}}};
  return table;
}
const Table& scan() {
  static const Table table{"scan", 3, {{"session", T}, {"laser", T}, {"second", I}, {"scans", I}, {"data", B}}};
  return table;
}
const Table& keyframe() {
  static const Table table{
      "keyframe", 3, {{"session", T}, {"camera", T}, {"stamp_ns", I}, {"image", B}, {"features", B}}, 2};
  return table;
}
const Table& input() {
  static const Table table{"input", 2, {{"session", T}, {"block", I}, {"events", I}, {"data", B}}};
  return table;
}
const Table& state() {
  static const Table table{"state", 3, {{"session", T}, {"stage", T}, {"part", I}, {"parts", I}, {"data", B}}};
  return table;
}

const std::vector<const Table*>& tables() {
  static const std::vector<const Table*> all = {&session(),  &anchor(),  &parameter(), &property(), &extrinsic(),
                                                &node(),     &relaxed(), &edge(),      &evidence(), &scan(),
                                                &keyframe(), &input(),   &state()};
  return all;
}

bool has(Connection& connection, const Table& table) {
  return connection.integer("PRAGMA user_version") >= table.since;
}

void create(Connection& connection) {
  std::string sql = "BEGIN IMMEDIATE;";
  for (const auto& [name, text] : allObjects(kSchemaVersion)) sql += text + ";";
  sql += "PRAGMA application_id=" + std::to_string(kApplicationId) +
         ";PRAGMA user_version=" + std::to_string(kSchemaVersion) + ";COMMIT";
  connection.execute(sql);
}

const std::vector<std::string>& migrationSteps() {
  static const std::vector<std::string> steps = [] {
    std::string keyframes;
    for (const auto& [name, text] : objectsOf(keyframe())) keyframes += text + ";";
    return std::vector<std::string>{"", keyframes};  // there was no version 0
  }();
  return steps;
}

void migrate(Connection& connection, const std::vector<std::string>& steps) {
  const std::int64_t from = connection.integer("PRAGMA user_version");
  if (from >= static_cast<std::int64_t>(steps.size())) return;
  connection.beginWriting();
  for (auto version = static_cast<std::size_t>(from); version < steps.size(); ++version)
    connection.execute(steps[version]);
  connection.execute("PRAGMA user_version=" + std::to_string(steps.size()));
  connection.commit();
}

void check(Connection& connection) {
  if (connection.integer("PRAGMA application_id") != kApplicationId)
    throw UserError(connection.name(), "is another program's SQLite file, and was left as it is",
                    "a session store of urban_nav, or a name where there is no file yet");
  const std::int64_t version = connection.integer("PRAGMA user_version");
  if (version > kSchemaVersion)
    throw UserError(connection.name(),
                    "was written by a newer urban_nav (schema " + std::to_string(version) + "), and was left as it is",
                    "schema " + std::to_string(kSchemaVersion) + " or older; or a newer urban_nav");
  if (version < 1) connection.damaged("schema " + std::to_string(version) + " has never been written");
  std::map<std::string, std::string> found;
  Statement statement = connection.prepare("SELECT name,sql FROM sqlite_master WHERE sql IS NOT NULL");
  while (statement.step()) found[std::string(statement.text(0))] = statement.text(1);
  for (const auto& [name, text] : allObjects(version)) {
    const auto object = found.find(name);
    if (object == found.end() || object->second != text) connection.damaged("table " + name + " is not as it was made");
  }
}

}  // namespace schema

std::string insertSql(const Table& table) {
  std::string marks = "?";
  for (std::size_t i = 0; i < table.columns.size(); ++i) marks += ",?";
  return "INSERT INTO " + std::string(table.name) + "(" + columnNames(table) + ") VALUES(" + marks + ")";
}

std::string putSql(const Table& table) {
  std::string sets;
  for (auto i = static_cast<std::size_t>(table.keys); i < table.columns.size(); ++i) {
    const std::string name = table.columns[i].name;
    sets += name + "=excluded." + name + ",";
  }
  return insertSql(table) + " ON CONFLICT(" + keyNames(table) + ") DO UPDATE SET " + sets + "crc=excluded.crc";
}

std::string selectSql(const Table& table, const std::string& rest) {
  return "SELECT " + columnNames(table) + " FROM " + table.name + (rest.empty() ? "" : " " + rest) + " ORDER BY " +
         keyNames(table);
}

std::string keySql(const Table& table) {
  std::string text;
  for (int i = 0; i < table.keys; ++i)
    text += (i > 0 ? " AND " : "") + std::string(table.columns[static_cast<std::size_t>(i)].name) + "=?";
  return text;
}

}  // namespace urban_nav_store
