// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "urban_nav_store/columns.hpp"

namespace urban_nav_store {

enum class ColumnType { Text, Integer, Real, Blob };

/// The value of a column of any type.
struct Value {
  ColumnType type = ColumnType::Integer;
  std::int64_t integer = 0;
  double real = 0.0;
  std::string bytes;  ///< text or blob
};
bool operator==(const Value& a, const Value& b);

struct Column {
  std::string name;
  ColumnType type = ColumnType::Integer;
  int since = 1;    ///< first version of the schema that has it
  Value initial{};  ///< of rows that are older than the column
};

/// How a merge treats two rows with the same key and different content.
enum class MergeRule {
  Contradiction,   ///< an error that names them
  LatestRevision,  ///< the row with the higher number in the column `revision` stays
  DropDifferent,   ///< neither stays, nor does any row with the same key but for its last column
  CompleteInAll,   ///< an error, unless the rows differ in the last column alone, a flag: it holds if it holds in both
};

/// Declaration of a table of the store. The schema, migration, checks, merge, dump, clear and remove are derived from
/// it.
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
/// A header of such a type in include/urban_nav_store/tables/, named after it (panorama.hpp: struct Panorama), is all
/// that a new table takes. `since` is the next version of the schema that no release has written.
struct Table {
  std::string name;
  std::size_t keys = 1;  ///< the first columns are the primary key; the very first is the session that a row belongs to
  int since = 1;         ///< first version of the schema that has the table
  bool wide = false;     ///< rows of more than some 200 bytes: stored apart from the index of their keys
  bool kept_by_clear = false;  ///< measurements, which stay when the results of a session are cleared
  bool of_graph = false;       ///< computed from all sessions of a graph together; a join of stores computes it anew
  MergeRule merge = MergeRule::Contradiction;
  std::string other_session{};    ///< name of another column that refers to a session; rows go with that session too
  std::vector<Column> columns{};  ///< filled in by declaredTable()
};

/// Returns the table with the columns that `visit` names.
Table withColumns(Table table, const std::function<void(Columns&)>& visit);

/// Returns the table of a row type. Thread-safe.
template <typename Row>
const Table& declaredTable() {
  static const Table table = withColumns(Row::table(), [](Columns& columns) { Row().columns(columns); });
  return table;
}

/// A row of any declared type, by reference.
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

/// Returns a row for writing. One function of the row both reads and writes, and hence takes it as mutable; writing
/// does not change it.
template <typename Row>
AnyRow unchanged(const Row& row) {
  return AnyRow(const_cast<Row&>(row));
}

}  // namespace urban_nav_store
