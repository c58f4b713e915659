// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/merge.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "file/header.hpp"
#include "schema/row.hpp"
#include "store_implementation.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

namespace fs = std::filesystem;
using urban_nav_core::DataError;
using urban_nav_core::UserError;

namespace {

constexpr std::size_t kNamed = 5;  // contradictions that an error spells out

/// Puts the rows of one source after the other into a target.
class Merger {
 public:
  explicit Merger(Connection& target) : target_(target) {}

  void add(Connection& source) {
    source_ = source.name();
    for (const Table* table : schema::tables())
      if (schema::has(source, *table)) addTable(source, *table);
  }

  /// DataError where rows contradict each other.
  MergeResult finish() {
    if (contradictions_ > 0) {
      throw DataError(target_.name(),
                      "is not made: " + std::to_string(contradictions_) + " rows contradict each other; " + named_,
                      "stores of other sessions, or of other parts of the same one");
    }
    for (const auto& [session, stage] : other_states_) dropState(session, stage);
    return result_;
  }

 private:
  void addTable(Connection& source, const Table& table) {
    std::set<std::string> sessions;
    RowReader reader(source, table, "");
    while (reader.next()) {
      const Row row = readRow(reader);
      sessions.insert(row.front().bytes);
      addRow(table, row);
    }
    for (const std::string& session : sessions) verifyTally(source, table, session);
  }

  void addRow(const Table& table, const Row& row) {
    const std::optional<Row> there = find(table, row);
    if (!there) {
      write(table, row);
      ++result_.rows;
    } else if (*there == row) {
      ++result_.identical;
    } else if (&table == &schema::session()) {
      addSession(*there, row);
    } else if (const std::optional<std::size_t> revision = revisionOf(table);
               revision && (*there)[*revision].integer != row[*revision].integer) {
      ++result_.outdated;
      if ((*there)[*revision].integer < row[*revision].integer) write(table, row);
    } else if (&table == &schema::state()) {
      other_states_.emplace(row[0].bytes, row[1].bytes);
    } else {
      contradict(table, row);
    }
  }

  /// Of two runs over one session: what one of them could go on from is no state of the other.
  void dropState(const std::string& session, const std::string& stage) {
    for (const char* what : {"SELECT COUNT(*)", "DELETE"}) {
      Statement statement = target_.prepare(std::string(what) + " FROM state WHERE session=? AND stage=?");
      statement.bind(0, session);
      statement.bind(1, stage);
      if (statement.step()) result_.rows -= statement.integer(0);
    }
  }

  /// One computer's part of a session may be complete and another's not.
  void addSession(const Row& there, const Row& row) {
    Row both = row;
    both.back().integer = std::min(there.back().integer, row.back().integer);
    Row known = there;
    known.back() = both.back();
    if (!(known == both)) return contradict(schema::session(), row);
    write(schema::session(), both);
    ++result_.identical;
  }

  static std::optional<std::size_t> revisionOf(const Table& table) {
    if (&table != &schema::relaxed() && &table != &schema::anchor()) return std::nullopt;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      if (std::string_view(table.columns[i].name) == "revision") return i;
    return std::nullopt;
  }

  std::optional<Row> find(const Table& table, const Row& row) {
    RowReader reader(target_, table, "WHERE " + keySql(table));
    for (int i = 0; i < table.keys; ++i) {
      const Value& value = row[static_cast<std::size_t>(i)];
      if (value.type == ColumnType::Integer) {
        reader.statement().bind(i, value.integer);
      } else {
        reader.statement().bind(i, std::string_view(value.bytes));
      }
    }
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
    named_ += (named_.empty() ? "" : "; ") + std::string(table.name) + " " + printKey(table, row) + " in " + source_ +
              " and before it";
  }

  Connection& target_;
  std::string source_, named_;
  std::int64_t contradictions_ = 0;
  std::set<std::pair<std::string, std::string>> other_states_;  // session and stage
  MergeResult result_;
};

/// Gives a finished file the name of the target. A store that stands there gives way: its log must be in it before another
/// file takes its name, or it would be taken for that one's.
void replace(const std::string& path, urban_nav_core::PartialFile& partial) {
  if (fileKind(path) == FileKind::Store) Store(path, Access::Write).close();
  const WriterLock lock(path);
  refuseOtherFiles(path);
  std::error_code error;
  if (fs::file_size(path + "-wal", error) > 0 && !error)
    throw UserError(path, "is being used by another program", "to be replaced when nobody uses it");
  partial.commit();
}

}  // namespace

MergeResult merge(const std::vector<std::string>& sources, const std::string& given) {
  const std::string path = resolved(given);
  refuseOtherFiles(path);
  urban_nav_core::PartialFile partial(path, ".merging");
  ::unlink(partial.path().c_str());  // of a process that was killed
  MergeResult result;
  {
    Store target(partial.path(), Access::Write);
    Connection& connection = target.implementation().connection;
    Merger merger(connection);
    for (const std::string& source : sources) {
      Store opened(source, Access::Read);
      merger.add(opened.implementation().connection);
    }
    result = merger.finish();
    target.commit();
    target.close();
  }
  replace(path, partial);
  return result;
}

}  // namespace urban_nav_store
