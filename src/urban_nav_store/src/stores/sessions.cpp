// SPDX-License-Identifier: BSD-3-Clause
#include "stores/sessions.hpp"

#include <algorithm>

#include "schema/row.hpp"
#include "stores/checks.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/bytes.hpp"
#include "urban_nav_store/digest.hpp"

namespace urban_nav_store {

using urban_nav_core::UserError;

namespace {

constexpr std::size_t kIdDigits = 20;
constexpr const char* kOfSession = "WHERE session=?";

Session readSession(RowReader& reader) {
  Session session;
  session.id = reader.text();
  session.name = reader.text();
  session.robot = reader.text();
  session.recording = reader.text();
  session.start = reader.integer();
  const std::int64_t complete = reader.integer();
  if (complete != 0 && complete != 1) reader.damaged("a session is neither complete nor not");
  session.complete = complete == 1;
  return session;
}

/// All rows of a session in a table, verified as a whole.
template <typename Read>
void readAll(Connection& connection, const Table& table, const SessionId& id, const Read& read) {
  RowReader reader(connection, table, kOfSession);
  reader.statement().bind(0, id);
  while (reader.next()) {
    reader.text();  // the session
    read(reader);
  }
  verifyTally(reader, id);
}

}  // namespace

SessionId sessionIdOf(const SessionOrigin& origin) {
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

void Sessions::put(const Session& session) {
  if (const std::optional<Session> there = find(session.id)) {
    if (there->robot != session.robot || there->recording != session.recording || there->start != session.start)
      throw UserError(connection_.name(), "session " + session.id + " is another one already (" + there->name + ")",
                      "");
  }
  RowWriter(connection_, putSql(schema::session()))
      .text(session.id)
      .text(session.name)
      .text(session.robot)
      .text(session.recording)
      .integer(session.start)
      .integer(session.complete ? 1 : 0)
      .write();
}

std::optional<Session> Sessions::find(const SessionId& id) const {
  RowReader reader(connection_, schema::session(), "WHERE id=?");
  reader.statement().bind(0, id);
  std::optional<Session> session;
  while (reader.next()) session = readSession(reader);
  verifyTally(reader, id);
  return session;
}

std::vector<Session> Sessions::all() const {
  std::vector<Session> sessions;
  RowReader reader(connection_, schema::session(), "");
  while (reader.next()) sessions.push_back(readSession(reader));
  Statement count = connection_.prepare("SELECT count(*) FROM tally WHERE name='session' AND count>0");
  if (!count.step() || count.integer(0) != reader.rows()) reader.damaged("there are fewer sessions than were written");
  std::sort(sessions.begin(), sessions.end(),
            [](const Session& a, const Session& b) { return a.start != b.start ? a.start < b.start : a.id < b.id; });
  return sessions;
}

void Sessions::clear(const SessionId& id) { remove(id, {&schema::scan(), &schema::keyframe()}); }

void Sessions::remove(const SessionId& id, const std::vector<const Table*>& but) {
  connection_.beginWriting();
  settle_();
  const auto clear = [&](const std::string& sql) {
    Statement statement = connection_.prepare(sql);
    statement.bind(0, id);
    statement.step();
  };
  for (const Table* table : schema::tables())
    if (std::find(but.begin(), but.end(), table) == but.end())
      clear("DELETE FROM " + std::string(table->name) + " WHERE " + table->columns.front().name + "=?");
  clear("DELETE FROM edge WHERE session_b=?");
  clear("DELETE FROM evidence WHERE session_b=?");
  clear("DELETE FROM anchor WHERE map=?");
  clear("DELETE FROM tally WHERE session=? AND count=0");
}

void Sessions::put(const Anchor& anchor) {
  refuseNotFinite(connection_, "the anchor of session " + anchor.session, anchor.T_map_odom);
  RowWriter(connection_, putSql(schema::anchor()))
      .text(anchor.session)
      .text(anchor.map)
      .integer(anchor.revision)
      .pose(anchor.T_map_odom)
      .write();
}

std::optional<Anchor> Sessions::anchor(const SessionId& id) const {
  std::optional<Anchor> anchor;
  readAll(connection_, schema::anchor(), id, [&](RowReader& reader) {
    anchor.emplace();
    anchor->session = id;
    anchor->map = reader.text();
    anchor->revision = reader.integer();
    anchor->T_map_odom = reader.pose();
  });
  return anchor;
}

void Sessions::put(const SessionId& id, const StoredParameter& parameter) {
  RowWriter(connection_, putSql(schema::parameter()))
      .text(id)
      .text(parameter.name)
      .text(parameter.value)
      .text(parameter.origin)
      .write();
}

std::vector<StoredParameter> Sessions::parameters(const SessionId& id) const {
  std::vector<StoredParameter> all;
  readAll(connection_, schema::parameter(), id, [&](RowReader& reader) {
    StoredParameter parameter;
    parameter.name = reader.text();
    parameter.value = reader.text();
    parameter.origin = reader.text();
    all.push_back(std::move(parameter));
  });
  return all;
}

void Sessions::put(const SessionId& id, const Property& property) {
  RowWriter(connection_, putSql(schema::property())).text(id).text(property.name).text(property.value).write();
}

std::vector<Property> Sessions::properties(const SessionId& id) const {
  std::vector<Property> all;
  readAll(connection_, schema::property(), id, [&](RowReader& reader) {
    Property property;
    property.name = reader.text();
    property.value = reader.text();
    all.push_back(std::move(property));
  });
  return all;
}

void Sessions::put(const SessionId& id, const Extrinsic& extrinsic) {
  refuseNotFinite(connection_, "the frame " + extrinsic.frame + " of session " + id, extrinsic.T_base_frame);
  RowWriter(connection_, putSql(schema::extrinsic()))
      .text(id)
      .text(extrinsic.frame)
      .pose(extrinsic.T_base_frame)
      .write();
}

std::vector<Extrinsic> Sessions::extrinsics(const SessionId& id) const {
  std::vector<Extrinsic> all;
  readAll(connection_, schema::extrinsic(), id, [&](RowReader& reader) {
    Extrinsic extrinsic;
    extrinsic.frame = reader.text();
    extrinsic.T_base_frame = reader.pose();
    all.push_back(std::move(extrinsic));
  });
  return all;
}

}  // namespace urban_nav_store
