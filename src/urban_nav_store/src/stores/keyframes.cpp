// SPDX-License-Identifier: BSD-3-Clause
#include "stores/keyframes.hpp"

#include "schema/row.hpp"

namespace urban_nav_store {

using urban_nav_core::StampNs;

bool operator==(const StoredKeyframe& a, const StoredKeyframe& b) {
  return a.stamp == b.stamp && a.image == b.image && a.features == b.features;
}

bool Keyframes::isThere() const { return schema::has(connection_, schema::keyframe()); }

void Keyframes::put(const SessionId& session, const std::string& camera, const StoredKeyframe& keyframe) {
  RowWriter(connection_, putSql(schema::keyframe()))
      .text(session)
      .text(camera)
      .integer(keyframe.stamp)
      .blob(keyframe.image)
      .blob(keyframe.features)
      .write();
  whole_.erase(session);
}

std::optional<StoredKeyframe> Keyframes::get(const SessionId& session, const std::string& camera, StampNs stamp) const {
  if (!isThere()) return std::nullopt;
  if (whole_.count(session) == 0) verifyTally(connection_, schema::keyframe(), session);
  whole_.insert(session);
  RowReader reader(connection_, schema::keyframe(), "WHERE " + keySql(schema::keyframe()));
  reader.statement().bind(0, session);
  reader.statement().bind(1, camera);
  reader.statement().bind(2, stamp);
  std::optional<StoredKeyframe> found;
  while (reader.next()) {
    reader.text();
    reader.text();
    found.emplace();
    found->stamp = reader.integer();
    found->image = reader.blob();
    found->features = reader.blob();
  }
  return found;
}

std::vector<StampNs> Keyframes::stamps(const SessionId& session, const std::string& camera) const {
  std::vector<StampNs> stamps;
  if (!isThere()) return stamps;
  Statement statement =
      connection_.prepare("SELECT stamp_ns FROM keyframe WHERE session=? AND camera=? ORDER BY stamp_ns");
  statement.bind(0, session);
  statement.bind(1, camera);
  while (statement.step()) stamps.push_back(statement.integer(0));
  return stamps;
}

std::vector<std::string> Keyframes::cameras(const SessionId& session) const {
  std::vector<std::string> names;
  if (!isThere()) return names;
  Statement statement = connection_.prepare("SELECT DISTINCT camera FROM keyframe WHERE session=? ORDER BY camera");
  statement.bind(0, session);
  while (statement.step()) names.emplace_back(statement.text(0));
  return names;
}

}  // namespace urban_nav_store
