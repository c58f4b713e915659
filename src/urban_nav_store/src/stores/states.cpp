// SPDX-License-Identifier: BSD-3-Clause
#include "stores/states.hpp"

#include <algorithm>
#include <limits>

#include "schema/row.hpp"
#include "sqlite/snapshot.hpp"
#include "tables/measurement_tables.hpp"
#include "urban_nav_store/deflate.hpp"

namespace urban_nav_store {

namespace {
constexpr std::size_t kPart = std::size_t{1} << 20;
}

void SqliteStageStates::put(const SessionId& session, const std::string& stage, std::string_view bytes) {
  remove(session, stage);
  const std::size_t parts = std::max<std::size_t>(1, (bytes.size() + kPart - 1) / kPart);
  StatePartRow row{session, stage, 0, static_cast<std::int64_t>(parts), ""};
  for (; row.part < row.parts; ++row.part) {
    row.data = deflated(bytes.substr(static_cast<std::size_t>(row.part) * kPart, kPart));
    tables_.put(declaredTable<StatePartRow>(), AnyRow(row));
  }
}

std::optional<std::string> SqliteStageStates::get(const SessionId& session, const std::string& stage) const {
  const Snapshot snapshot(tables_.connection());  // all parts of one state
  verifyTally(tables_.connection(), declaredTable<StatePartRow>(), session);
  StatePartRow row{session, stage, 0, 0, ""};
  std::string bytes;
  std::int64_t next = 0;
  const auto damaged = [&](const std::string& what) {
    tables_.connection().damaged("in table state, the state of stage " + stage + " " + what);
  };
  tables_.forEachBetween(declaredTable<StatePartRow>(), AnyRow(row), std::numeric_limits<std::int64_t>::min(),
                         std::numeric_limits<std::int64_t>::max(), [&] {
                           const std::optional<std::string> unpacked = inflated(row.data, kPart);
                           if (row.part != next++ || !unpacked) damaged("cannot be unpacked");
                           bytes += *unpacked;
                         });
  if (next != row.parts) damaged("is incomplete");
  if (next == 0) return std::nullopt;
  return bytes;
}

void SqliteStageStates::remove(const SessionId& session, const std::string& stage) {
  tables_.remove(declaredTable<StatePartRow>(), unchanged(StatePartRow{session, stage, 0, 0, ""}), 2);
}

std::int64_t SqliteStageStates::bytes(const SessionId& session) const {
  Statement statement =
      tables_.connection().prepare("SELECT COALESCE(SUM(LENGTH(data)), 0) FROM state WHERE session=?");
  statement.bind(0, session);
  statement.step();
  return statement.integer(0);
}

std::vector<std::string> SqliteStageStates::stages(const SessionId& session) const {
  return tables_.secondKeys(declaredTable<StatePartRow>(), session);
}

}  // namespace urban_nav_store
