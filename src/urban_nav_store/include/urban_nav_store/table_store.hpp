// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

class Store;
class TableAccess;

/// Reads and writes rows of one table of any type; the base of TableStore.
class AnyTableStore {
 public:
  AnyTableStore(Store& store, const Table& table);

 protected:
  void putRow(const AnyRow& row);
  bool getRow(const AnyRow& row) const;
  void removeRow(const AnyRow& key);
  void forEachRow(const SessionId& session, const AnyRow& row, const std::function<void()>& visit) const;
  void forEachRowBetween(const AnyRow& row, std::int64_t from, std::int64_t to,
                         const std::function<void()>& visit) const;
  std::vector<std::int64_t> lastKeysBetween(const AnyRow& row, std::int64_t from, std::int64_t to) const;

 private:
  TableAccess* access_;
  const Table* table_;
};

/// Rows of one table of a store. A file older than the table has no rows; opening it for writing adds the table. The
/// store must outlive this object. Throws UserError for values that are not finite, DataError for damaged files.
template <typename Row>
class TableStore : private AnyTableStore {
 public:
  explicit TableStore(Store& store) : AnyTableStore(store, declaredTable<Row>()) {}

  /// Writes a row, replacing one with the same key.
  void put(const Row& row) { putRow(unchanged(row)); }

  /// Returns the row with the key columns of `key`.
  std::optional<Row> get(Row key) const {
    if (!getRow(AnyRow(key))) return std::nullopt;
    return key;
  }

  /// Removes the row with the key columns of `key`, if it exists.
  void remove(const Row& key) { removeRow(unchanged(key)); }

  /// Calls `visit` for all rows of a session in the order of their keys. Throws DataError at the end if a row is
  /// missing.
  void forEach(const SessionId& session, const std::function<void(const Row&)>& visit) const {
    Row row;
    forEachRow(session, AnyRow(row), [&] { visit(row); });
  }

  /// Calls `visit` in ascending order for the rows whose last key, an integer, is in from...to and whose other keys are
  /// those of `key`.
  void forEachBetween(Row key, std::int64_t from, std::int64_t to, const std::function<void(const Row&)>& visit) const {
    forEachRowBetween(AnyRow(key), from, to, [&] { visit(key); });
  }

  /// Returns the last keys of these rows, ascending, without reading the rows.
  std::vector<std::int64_t> keysBetween(const Row& key, std::int64_t from, std::int64_t to) const {
    return lastKeysBetween(unchanged(key), from, to);
  }
};

}  // namespace urban_nav_store
