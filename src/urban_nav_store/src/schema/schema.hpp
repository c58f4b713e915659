// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sqlite/connection.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

using Tables = std::vector<const Table*>;

namespace schema {

/// "UNav": SQLite's application id in the header of a store.
constexpr int kApplicationId = 0x554e6176;
/// "UNre": application id of a release, which has the schema of a store and is never written to.
constexpr int kReleaseId = 0x554e7265;

/// Returns all declared tables in the order in which they are created, merged and dumped.
const Tables& tables();

/// Returns the latest schema version of these tables: the highest `since` of a table or column.
int latestVersion(const Tables& tables);

/// Returns the version of the schema of a file.
int version(Connection& connection);

/// Returns a table in an earlier schema version, which must have it: without columns added later.
Table atVersion(const Table& table, int version);

/// Creates the tables of a version in an empty file.
void create(Connection& connection, const Tables& tables, int version);
inline void create(Connection& connection) { create(connection, tables(), latestVersion(tables())); }

/// Migrates a file of an earlier version to the latest one in one transaction: tables added later are created, and
/// tables with columns added later are rewritten with the initial values of these. No effect in a file of the latest
/// version.
void migrate(Connection& connection, const Tables& tables);

/// Throws an error naming the file if it belongs to another program, has a newer version, or is damaged (tables differ
/// from their declaration).
void check(Connection& connection, const Tables& tables);
inline void check(Connection& connection) { check(connection, tables()); }

}  // namespace schema

/// Returns the INSERT of a row with its checksum; a row with the same key is replaced.
std::string putSql(const Table& table);
/// Returns the INSERT of a row with its checksum; a row with this key must not exist.
std::string insertSql(const Table& table);
/// Returns the SELECT of all columns and the checksum, in the order of the key. `condition`: empty or "WHERE ...".
std::string selectSql(const Table& table, const std::string& condition);
/// Returns "session=? AND stamp_ns=?" for the first `keys` columns of the key.
std::string keySql(const Table& table, std::size_t keys);

}  // namespace urban_nav_store
