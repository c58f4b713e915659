// SPDX-License-Identifier: BSD-3-Clause
#include "stores/states.hpp"

#include <algorithm>

#include "blocks/deflate.hpp"
#include "schema/row.hpp"

namespace urban_nav_store {

namespace {
constexpr std::size_t kPart = std::size_t{1} << 20;
}

void States::put(const SessionId& session, const std::string& stage, std::string_view bytes) {
  remove(session, stage);
  const std::size_t parts = std::max<std::size_t>(1, (bytes.size() + kPart - 1) / kPart);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::string packed = deflated(bytes.substr(part * kPart, kPart));
    RowWriter(connection_, insertSql(schema::state()))
        .text(session)
        .text(stage)
        .integer(static_cast<std::int64_t>(part))
        .integer(static_cast<std::int64_t>(parts))
        .blob(packed)
        .write();
  }
}

std::optional<std::string> States::get(const SessionId& session, const std::string& stage) const {
  verifyTally(connection_, schema::state(), session);
  RowReader reader(connection_, schema::state(), "WHERE session=? AND stage=?");
  reader.statement().bind(0, session);
  reader.statement().bind(1, stage);
  std::string bytes;
  std::int64_t next = 0, parts = 0;
  while (reader.next()) {
    reader.text();
    reader.text();
    const std::int64_t part = reader.integer();
    parts = reader.integer();
    const std::optional<std::string> unpacked = inflated(reader.blob(), kPart);
    if (part != next++ || !unpacked) reader.damaged("the state of stage " + stage + " cannot be unpacked");
    bytes += *unpacked;
  }
  if (next != parts) reader.damaged("the state of stage " + stage + " has lost a part");
  if (next == 0) return std::nullopt;
  return bytes;
}

void States::remove(const SessionId& session, const std::string& stage) {
  connection_.beginWriting();
  Statement statement = connection_.prepare("DELETE FROM state WHERE session=? AND stage=?");
  statement.bind(0, session);
  statement.bind(1, stage);
  statement.step();
}

std::int64_t States::bytes(const SessionId& session) const {
  Statement statement = connection_.prepare("SELECT COALESCE(SUM(LENGTH(data)), 0) FROM state WHERE session=?");
  statement.bind(0, session);
  statement.step();
  return statement.integer(0);
}

std::vector<std::string> States::stages(const SessionId& session) const {
  std::vector<std::string> names;
  Statement statement = connection_.prepare("SELECT DISTINCT stage FROM state WHERE session=? ORDER BY stage");
  statement.bind(0, session);
  while (statement.step()) names.emplace_back(statement.text(0));
  return names;
}

}  // namespace urban_nav_store
