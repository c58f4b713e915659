// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/merge.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "file/header.hpp"
#include "merge_journal.hpp"
#include "schema/row.hpp"
#include "store_implementation.hpp"
#include "tables/graph_tables.hpp"
#include "tables/session_tables.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/tables/edge_number.hpp"
#include "urban_nav_store/tables/stored_edit.hpp"

namespace urban_nav_store {

namespace fs = std::filesystem;
using urban_nav_core::DataError;
using urban_nav_core::UserError;

namespace {

constexpr std::size_t kNamed = 5;                                      // contradictions listed in an error
constexpr const char* kMeasuring[] = {"loop_metric", "laser_mapper"};  // stages that measure closures

/// Orders keys of rows to be dropped.
struct LessByText {
  bool operator()(const std::pair<const Table*, Row>& a, const std::pair<const Table*, Row>& b) const {
    return text(a) < text(b);
  }
  static std::vector<std::string> text(const std::pair<const Table*, Row>& keys) {
    std::vector<std::string> all = {keys.first->name};
    for (const Value& value : keys.second) all.push_back(value.bytes + "," + std::to_string(value.integer));
    return all;
  }
};

/// Adds the rows of one source after the other to a target.
class Merger {
 public:
  /// `journals`: merge edits and numbers of edges like other rows; otherwise JournalMerge does.
  Merger(Connection& target, MergeContent content, bool journals, RowFilter takes = {})
      : target_(target), content_(content), journals_(journals), takes_(std::move(takes)) {}

  void add(Connection& source) {
    source_ = source.name();
    const int version = schema::version(source);
    for (const Table* table : schema::tables())
      if (table->since <= version && isWanted(*table)) addTable(source, schema::atVersion(*table, version), *table);
  }

  /// Throws DataError if rows contradict each other.
  MergeResult finish() {
    if (contradictions_ > 0) {
      throw DataError(target_.name(),
                      "is not written: " + std::to_string(contradictions_) + " rows contradict each other; " + named_,
                      "stores of other sessions, or of other parts of the same one");
    }
    for (const auto& [table, keys] : dropped_) drop(*table, keys);
    return result_;
  }

 private:
  bool isWanted(const Table& table) const {
    if (!journals_ && (&table == &declaredTable<StoredEdit>() || &table == &declaredTable<EdgeNumber>())) return false;
    return content_ == MergeContent::All || !table.of_graph || &table == &declaredTable<EvidenceRow>();
  }

  /// `stored`: the table in the source's version.
  void addTable(Connection& source, const Table& stored, const Table& table) {
    RowReader reader(source, stored, "");
    while (reader.next()) {
      Row row = completed(readRow(reader), stored, table);
      if (content_ == MergeContent::Sessions) forgetVerdict(table, row);
      if ((content_ == MergeContent::All || !isClosure(table, row)) && isTaken(table, row)) addRow(table, row);
    }
    verifyTally(source, stored);
  }

  /// Resets the results of the relaxation stored in an edge, which another relaxation determines again.
  static void forgetVerdict(const Table& table, Row& row) {
    if (&table != &declaredTable<EdgeRow>()) return;
    row[indexOf(table, "weight")].real = Edge().weight;
    row[indexOf(table, "verdict")].bytes = toString(Edge().verdict);
    row[indexOf(table, "reason")].bytes = Edge().reason;
  }

  bool isTaken(const Table& table, const Row& row) const {
    return !takes_ || takes_(table, Row(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(table.keys)));
  }

  /// Returns whether a row is an edge, or evidence of one, that a joint relaxation of all sessions measures again.
  static bool isClosure(const Table& table, const Row& row) {
    if (&table != &declaredTable<EdgeRow>() && &table != &declaredTable<EvidenceRow>()) return false;
    const std::optional<EdgeKind> kind = parseEdgeKind(row[indexOf(table, "kind")].bytes);
    return kind && isFoundAnew(*kind, row[indexOf(table, "source")].bytes);
  }

  void addRow(const Table& table, const Row& row) {
    const std::optional<Row> there = find(table, row);
    if (!there) {
      write(table, row);
      ++result_.rows;
    } else if (*there == row) {
      ++result_.identical;
    } else {
      addDifferent(table, *there, row);
    }
  }

  void addDifferent(const Table& table, const Row& there, const Row& row) {
    switch (table.merge) {
      case MergeRule::Contradiction:
        return isOfRun(table, row) ? keepLesser(table, there, row) : contradict(table, row);
      case MergeRule::LatestRevision: return addRevision(table, there, row);
      case MergeRule::CompleteInAll: return addPart(table, there, row);
      case MergeRule::DropDifferent: break;
    }
    dropped_.emplace(&table, Row(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(table.keys) - 1));
  }

  /// Returns whether a row describes the run that read a session rather than the session: input path, options and
  /// parameters. Their effect is contained in the measurements.
  bool isOfRun(const Table& table, const Row& row) const {
    if (&table == &declaredTable<ParameterRow>()) return true;
    if (&table == &declaredTable<EvidenceRow>()) return content_ == MergeContent::Sessions;
    if (&table != &declaredTable<PropertyRow>()) return false;
    const std::string& name = row[indexOf(table, "name")].bytes;
    return name.rfind("run/", 0) == 0 || name.rfind("input/", 0) == 0;
  }

  void keepLesser(const Table& table, const Row& there, const Row& row) {
    ++result_.identical;
    const auto isLess = [](const Value& a, const Value& b) { return a.bytes < b.bytes; };
    if (std::lexicographical_compare(row.begin(), row.end(), there.begin(), there.end(), isLess)) write(table, row);
  }

  void addRevision(const Table& table, const Row& there, const Row& row) {
    const std::size_t revision = indexOf(table, "revision");
    if (there[revision].integer == row[revision].integer) return contradict(table, row);
    ++result_.outdated;
    if (there[revision].integer < row[revision].integer) write(table, row);
  }

  /// Merges rows whose last column is a flag: one computer's part of a session may be complete and another's not.
  void addPart(const Table& table, const Row& there, const Row& row) {
    Row both = row;
    both.back().integer = std::min(there.back().integer, row.back().integer);
    Row known = there;
    known.back() = both.back();
    if (!(known == both)) return contradict(table, row);
    write(table, both);
    ++result_.identical;
  }

  /// Removes the rows with these leading keys.
  void drop(const Table& table, const Row& keys) {
    for (const char* what : {"SELECT COUNT(*)", "DELETE"}) {
      Statement statement =
          target_.prepare(std::string(what) + " FROM " + table.name + " WHERE " + keySql(table, keys.size()));
      bindKey(statement, keys, keys.size());
      if (statement.step()) result_.rows -= statement.integer(0);
    }
  }

  static std::size_t indexOf(const Table& table, const std::string& name) {
    const auto found = std::find_if(table.columns.begin(), table.columns.end(),
                                    [&](const Column& column) { return column.name == name; });
    return static_cast<std::size_t>(found - table.columns.begin());
  }

  static void bindKey(Statement& statement, const Row& row, std::size_t keys) {
    for (std::size_t i = 0; i < keys; ++i) {
      const int parameter = static_cast<int>(i);
      if (row[i].type == ColumnType::Integer) {
        statement.bind(parameter, row[i].integer);
      } else {
        statement.bind(parameter, std::string_view(row[i].bytes));
      }
    }
  }

  std::optional<Row> find(const Table& table, const Row& row) {
    RowReader reader(target_, table, "WHERE " + keySql(table, table.keys));
    bindKey(reader.statement(), row, table.keys);
    std::optional<Row> found;
    while (reader.next()) found = readRow(reader);
    return found;
  }

  void write(const Table& table, const Row& row) {
    RowWriter writer(target_, putSql(table));
    writeRow(writer, row);
  }

  void contradict(const Table& table, const Row& row) {
    if (++contradictions_ > static_cast<std::int64_t>(kNamed)) return;
    named_ +=
        (named_.empty() ? "" : "; ") + table.name + " " + printKey(table, row) + " in " + source_ + " and before it";
  }

  Connection& target_;
  const MergeContent content_;
  const bool journals_;
  const RowFilter takes_;  // empty: all rows
  std::string source_, named_;
  std::int64_t contradictions_ = 0;
  /// Rows with different content in two sources: the table, and all keys but the last.
  std::set<std::pair<const Table*, Row>, LessByText> dropped_;
  MergeResult result_;
};

/// Renames a finished file to the target. The log of an existing store must be checkpointed before another file takes
/// its name; otherwise it would be applied to that file.
void replace(const std::string& path, urban_nav_core::PartialFile& partial) {
  if (fileKind(path) == FileKind::Store) Store(path, Access::Write).close();
  const WriterLock lock(path);
  refuseOtherFiles(path);
  std::error_code error;
  if (fs::file_size(path + "-wal", error) > 0 && !error)
    throw UserError(path, "is in use by another program", "a target that no program uses");
  partial.commit();
}

}  // namespace

bool isFoundAnew(EdgeKind kind, const std::string& source) {
  if (kind == EdgeKind::Odometry || kind == EdgeKind::Asserted) return false;
  const bool is_measured = std::find(std::begin(kMeasuring), std::end(kMeasuring), source) != std::end(kMeasuring);
  return is_measured || kind == EdgeKind::Plane || kind == EdgeKind::Session;
}

MergeResult merge(const std::vector<std::string>& sources, const std::string& given, MergeContent content) {
  const std::string path = resolved(given);
  refuseOtherFiles(path);
  urban_nav_core::PartialFile partial(path, ".merging");
  ::unlink(partial.path().c_str());  // left by a killed process
  MergeResult result;
  {
    Store target(partial.path(), Access::Write);
    Connection& connection = target.implementation().connection;
    Merger merger(connection, content, false);
    JournalMerge journals;
    for (const std::string& source : sources) {
      Store opened(source, Access::Snapshot);
      merger.add(opened.implementation().connection);
      journals.add(opened);
    }
    result = merger.finish();
    journals.write(target, content == MergeContent::All);
    target.commit();
    target.close();
  }
  replace(path, partial);
  return result;
}

void copyRows(const std::string& source, const std::string& path, const RowFilter& takes) {
  Store target(path, Access::Write);
  Merger merger(target.implementation().connection, MergeContent::All, true, takes);
  Store opened(source, Access::Frozen);
  merger.add(opened.implementation().connection);
  merger.finish();
  target.commit();
  target.close();
}

}  // namespace urban_nav_store
