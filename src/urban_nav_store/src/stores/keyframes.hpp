// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "schema/table_access.hpp"
#include "urban_nav_store/keyframe_store.hpp"

namespace urban_nav_store {

class SqliteKeyframeStore : public KeyframeStore {
 public:
  explicit SqliteKeyframeStore(TableAccess& tables) : tables_(tables) {}

  void put(const SessionId& session, const std::string& camera, const StoredKeyframe& keyframe) override;
  std::optional<StoredKeyframe> get(const SessionId& session, const std::string& camera,
                                    urban_nav_core::StampNs stamp) const override;
  std::vector<urban_nav_core::StampNs> stamps(const SessionId& session, const std::string& camera) const override;
  std::vector<std::string> cameras(const SessionId& session) const override;

 private:
  TableAccess& tables_;
};

}  // namespace urban_nav_store
