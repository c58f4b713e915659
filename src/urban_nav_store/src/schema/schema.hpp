// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sqlite/connection.hpp"

namespace urban_nav_store {

enum class ColumnType { Text, Integer, Real, Blob };

struct Column {
  const char* name;
  ColumnType type;
};

/// A table of the store. The first `keys` columns are its primary key, and the first of them is the session that a row belongs to. Each table
/// has one column more, `crc`: the checksum of the row (row.hpp), in front of wide columns so that it is read without them.
struct Table {
  const char* name;
  int keys;
  std::vector<Column> columns;
  int since = 1;  ///< version of the schema that had it first
};

namespace schema {

const Table& session();
const Table& anchor();
const Table& parameter();
const Table& property();
const Table& extrinsic();
const Table& node();
const Table& relaxed();
const Table& edge();
const Table& evidence();
const Table& scan();
const Table& keyframe();
const Table& input();
const Table& state();

/// In the order in which they are written, merged and dumped.
const std::vector<const Table*>& tables();

/// False in a file of a version that had no such table yet; one that is only read stays of that version.
bool has(Connection& connection, const Table& table);

/// "UNav": what the header of the file has as SQLite's application id.
constexpr int kApplicationId = 0x554e6176;

/// Makes the tables in an empty file.
void create(Connection& connection);

/// Brings a file of an earlier version to this one, step by step in one transaction: steps[v] makes version v + 1 out of v.
void migrate(Connection& connection, const std::vector<std::string>& steps);
const std::vector<std::string>& migrationSteps();

/// Errors that name the file: another program's, a newer version's, or damaged (tables are not what they were made as).
void check(Connection& connection);

}  // namespace schema

/// INSERT of a whole row with its checksum; a row with the same key is replaced.
std::string putSql(const Table& table);
/// The same, where a row with this key must not be there.
std::string insertSql(const Table& table);
/// All columns and the checksum; `rest`: WHERE ... without ORDER, rows come in the order of the key.
std::string selectSql(const Table& table, const std::string& rest);
/// "session=? AND stamp_ns=?"
std::string keySql(const Table& table);

}  // namespace urban_nav_store
