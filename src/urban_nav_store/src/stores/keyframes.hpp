// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>

#include "sqlite/connection.hpp"
#include "urban_nav_store/keyframe_store.hpp"

namespace urban_nav_store {

class Keyframes : public KeyframeStore {
 public:
  explicit Keyframes(Connection& connection) : connection_(connection) {}

  void put(const SessionId& session, const std::string& camera, const StoredKeyframe& keyframe) override;
  std::optional<StoredKeyframe> get(const SessionId& session, const std::string& camera,
                                    urban_nav_core::StampNs stamp) const override;
  std::vector<urban_nav_core::StampNs> stamps(const SessionId& session, const std::string& camera) const override;
  std::vector<std::string> cameras(const SessionId& session) const override;

 private:
  bool isThere() const;

  Connection& connection_;
  mutable std::set<SessionId> whole_;  // found so since the last one was written
};

}  // namespace urban_nav_store
