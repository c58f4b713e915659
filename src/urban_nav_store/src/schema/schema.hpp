// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sqlite/connection.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

using Tables = std::vector<const Table*>;

namespace schema {

/// "UNav": SQLite's application id in the header of the file.
constexpr int kApplicationId = 0x554e6176;
/// "UNre": that of a release, which has the schema of a store and is never written to.
constexpr int kReleaseId = 0x554e7265;

/// Returns all declared tables in the order in which they are created, merged and dumped.
const Tables& tables();

/// Returns the version of the schema of these tables: the highest that one of their tables or columns exists since.
int latestVersion(const Tables& tables);

/// Returns the version of the schema of a file.
int version(Connection& connection);

/// Returns the table as it is in a schema of this version, which must have it: without the columns that came later.
Table atVersion(const Table& table, int version);

/// Creates the tables of a version in an empty file.
void create(Connection& connection, const Tables& tables, int version);
inline void create(Connection& connection) { create(connection, tables(), latestVersion(tables())); }

/// Brings a file of an earlier version to the latest one in one transaction: tables that came later are created, and
/// tables with columns that came later are written anew with the initial values of these. Does nothing in a file of the
/// latest version.
void migrate(Connection& connection, const Tables& tables);

/// Throws an error that names the file if it is another program's, of a newer version, or damaged (tables differ from
/// their declaration).
void check(Connection& connection, const Tables& tables);
inline void check(Connection& connection) { check(connection, tables()); }

}  // namespace schema

/// Returns the INSERT of a whole row with its checksum; a row with the same key is replaced.
std::string putSql(const Table& table);
/// Returns the INSERT of a whole row with its checksum; a row with this key must not be there.
std::string insertSql(const Table& table);
/// Returns the SELECT of all columns and the checksum, in the order of the key. `condition`: empty or "WHERE ...".
std::string selectSql(const Table& table, const std::string& condition);
/// "session=? AND stamp_ns=?": the first `keys` columns of the key.
std::string keySql(const Table& table, std::size_t keys);

}  // namespace urban_nav_store
