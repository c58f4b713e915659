// SPDX-License-Identifier: BSD-3-Clause
#include "stores/sessions.hpp"

#include <algorithm>

#include "schema/schema.hpp"
#include "sqlite/snapshot.hpp"
#include "tables/session_tables.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/digest.hpp"

namespace urban_nav_store {

using urban_nav_core::UserError;

namespace {

constexpr std::size_t kIdDigits = 20;

/// Returns the member `part` of all rows of a session.
template <typename Row, typename Part>
std::vector<Part> sessionRows(TableAccess& tables, const SessionId& id, Part Row::*part) {
  std::vector<Part> all;
  Row row;
  tables.forEach(declaredTable<Row>(), id, AnyRow(row), [&] { all.push_back(row.*part); });
  return all;
}

}  // namespace

SessionId makeSessionId(const SessionOrigin& origin) {
  std::string bytes = "urban_nav session";
  appendText(bytes, origin.robot);
  appendText(bytes, origin.recording);
  appendInteger(bytes, static_cast<std::uint64_t>(origin.start));
  appendText(bytes, origin.inputs);
  return sha256(bytes).substr(0, kIdDigits);
}

bool operator==(const Session& a, const Session& b) {
  return a.id == b.id && a.name == b.name && a.robot == b.robot && a.recording == b.recording && a.start == b.start &&
         a.complete == b.complete;
}

void SqliteSessionStore::put(const Session& session) {
  if (const std::optional<Session> there = find(session.id)) {
    if (there->robot != session.robot || there->recording != session.recording || there->start != session.start)
      throw UserError(tables_.connection().name(),
                      "session " + session.id + " already exists with another origin (" + there->name + ")", "");
  }
  tables_.put(declaredTable<SessionRow>(), unchanged(SessionRow{session}));
}

std::optional<Session> SqliteSessionStore::find(const SessionId& id) const {
  const std::vector<Session> found = sessionRows(tables_, id, &SessionRow::session);
  return found.empty() ? std::nullopt : std::optional<Session>(found.front());
}

std::vector<Session> SqliteSessionStore::all() const {
  const Snapshot snapshot(tables_.connection());  // rows and tally
  std::vector<Session> sessions;
  SessionRow row;
  tables_.forEachRow(declaredTable<SessionRow>(), AnyRow(row), [&] { sessions.push_back(row.session); });
  if (tables_.sessions(declaredTable<SessionRow>()) != sessions.size())
    tables_.connection().damaged("in table session, fewer sessions than were written");
  std::sort(sessions.begin(), sessions.end(),
            [](const Session& a, const Session& b) { return a.start != b.start ? a.start < b.start : a.id < b.id; });
  return sessions;
}

void SqliteSessionStore::remove(const SessionId& id) {
  removeRows(id, [](const Table&) { return true; });
}

void SqliteSessionStore::clear(const SessionId& id) {
  removeRows(id, [](const Table& table) { return !table.kept_by_clear; });
}

void SqliteSessionStore::removeRows(const SessionId& id, const std::function<bool(const Table&)>& goes) {
  tables_.connection().beginWriting();
  settle_();
  for (const Table* table : schema::tables()) {
    if (!goes(*table)) continue;
    tables_.removeSession(*table, table->columns.front().name, id);
    if (!table->other_session.empty()) tables_.removeSession(*table, table->other_session, id);
  }
  tables_.forgetEmpty(id);
}

void SqliteSessionStore::put(const Anchor& anchor) {
  tables_.put(declaredTable<AnchorRow>(), unchanged(AnchorRow{anchor}));
}

std::optional<Anchor> SqliteSessionStore::anchor(const SessionId& id) const {
  const std::vector<Anchor> found = sessionRows(tables_, id, &AnchorRow::anchor);
  return found.empty() ? std::nullopt : std::optional<Anchor>(found.front());
}

void SqliteSessionStore::put(const SessionId& id, const StoredParameter& parameter) {
  tables_.put(declaredTable<ParameterRow>(), unchanged(ParameterRow{id, parameter}));
}

std::vector<StoredParameter> SqliteSessionStore::parameters(const SessionId& id) const {
  return sessionRows(tables_, id, &ParameterRow::parameter);
}

void SqliteSessionStore::put(const SessionId& id, const Property& property) {
  tables_.put(declaredTable<PropertyRow>(), unchanged(PropertyRow{id, property}));
}

std::vector<Property> SqliteSessionStore::properties(const SessionId& id) const {
  return sessionRows(tables_, id, &PropertyRow::property);
}

void SqliteSessionStore::put(const SessionId& id, const Extrinsic& extrinsic) {
  tables_.put(declaredTable<ExtrinsicRow>(), unchanged(ExtrinsicRow{id, extrinsic}));
}

std::vector<Extrinsic> SqliteSessionStore::extrinsics(const SessionId& id) const {
  return sessionRows(tables_, id, &ExtrinsicRow::extrinsic);
}

}  // namespace urban_nav_store
