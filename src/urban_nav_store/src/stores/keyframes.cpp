// SPDX-License-Identifier: BSD-3-Clause
#include "stores/keyframes.hpp"

#include "tables/measurement_tables.hpp"

namespace urban_nav_store {

using urban_nav_core::StampNs;

bool operator==(const StoredKeyframe& a, const StoredKeyframe& b) {
  return a.stamp == b.stamp && a.image == b.image && a.features == b.features;
}

void SqliteKeyframeStore::put(const SessionId& session, const std::string& camera, const StoredKeyframe& keyframe) {
  tables_.put(declaredTable<KeyframeRow>(), unchanged(KeyframeRow{session, camera, keyframe}));
}

std::optional<StoredKeyframe> SqliteKeyframeStore::get(const SessionId& session, const std::string& camera,
                                                       StampNs stamp) const {
  tables_.verifyOnce(declaredTable<KeyframeRow>(), session);
  KeyframeRow row{session, camera, {stamp, "", ""}};
  if (!tables_.find(declaredTable<KeyframeRow>(), AnyRow(row))) return std::nullopt;
  return std::move(row.keyframe);
}

std::vector<StampNs> SqliteKeyframeStore::stamps(const SessionId& session, const std::string& camera) const {
  return tables_.lastKeys(declaredTable<KeyframeRow>(), unchanged(KeyframeRow{session, camera, {}}));
}

std::vector<std::string> SqliteKeyframeStore::cameras(const SessionId& session) const {
  return tables_.secondKeys(declaredTable<KeyframeRow>(), session);
}

}  // namespace urban_nav_store
