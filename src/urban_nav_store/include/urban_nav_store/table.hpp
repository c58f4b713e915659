// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "urban_nav_store/columns.hpp"

namespace urban_nav_store {
/// Type of the values of a column.
enum class ColumnType { Text, Integer, Real, Blob };

/// Value of a column of any type.
struct Value {
  ColumnType type = ColumnType::Integer;
  std::int64_t integer = 0;
  double real = 0.0;
  std::string bytes;  ///< text or blob
};
bool operator==(const Value& a, const Value& b);
/// A column of a table of the store.
struct Column {
  std::string name;
  ColumnType type = ColumnType::Integer;
  int since = 1;    ///< first version of the schema with this column
  Value initial{};  ///< value in rows older than the column
};

/// Rule of a merge for rows with the same key and different content.
enum class MergeRule {
  Contradiction,   ///< an error that names them
  LatestRevision,  ///< the row with the higher number in the column `revision` is kept
  DropDifferent,   ///< neither is kept, nor any row with the same key except for its last column
  CompleteInAll,   ///< an error, unless the rows differ only in the last column, a flag: the merged value is their
                   ///< logical and
};

/// Declaration of a table of the store, from which schema, migration, checks, merge, dump, clear and remove are
/// derived.
///
/// A row type declares its table:
///
///   struct Panorama {
///     SessionId session;
///     urban_nav_core::StampNs stamp = 0;
///     std::string image;
///     static Table table() {
///       Table table{"panorama", 2};
///       table.since = 3;
///       table.wide = true;
///       return table;
///     }
///     void columns(Columns& columns);  // see Columns
///   };
///
/// A new table requires only a header with such a type in include/urban_nav_store/tables/, named after it
/// (panorama.hpp: struct Panorama). `since` is the next version of the schema, which no release has written.
struct Table {
  std::string name;
  std::size_t keys = 1;        ///< the first columns are the primary key; the very first is the session of a row
  int since = 1;               ///< first version of the schema with this table
  bool wide = false;           ///< rows of more than about 200 bytes: stored separately from the index of their keys
  bool kept_by_clear = false;  ///< measurements, which are kept when the results of a session are cleared
  bool of_graph = false;       ///< computed jointly from all sessions of a graph; a join of stores computes it again
  MergeRule merge = MergeRule::Contradiction;
  std::string other_session{};    ///< another column that refers to a session; rows are removed with that session too
  std::vector<Column> columns{};  ///< filled in by declaredTable()
};

/// Returns the table with the columns visited by `visit`.
Table withColumns(Table table, const std::function<void(Columns&)>& visit);

/// Returns the table of a row type. Thread-safe.
template <typename Row>
const Table& declaredTable() {
  static const Table table = withColumns(Row::table(), [](Columns& columns) { Row().columns(columns); });
  return table;
}

/// Row of any declared type, by reference.
class AnyRow {
 public:
  template <typename Row>
  explicit AnyRow(Row& row)
      : row_(&row), visit_([](void* each, Columns& columns) { static_cast<Row*>(each)->columns(columns); }) {}

  void columns(Columns& columns) const { visit_(row_, columns); }

 private:
  void* row_;
  void (*visit_)(void*, Columns&);
};

/// Returns a row for writing. The row's function for reading and writing takes it as mutable; writing does not change
/// it.
template <typename Row>
AnyRow unchanged(const Row& row) {
  return AnyRow(const_cast<Row&>(row));
}

}  // namespace urban_nav_store
