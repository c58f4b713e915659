// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "schema/schema.hpp"
#include "sqlite/connection.hpp"
#include "urban_nav_store/session_store.hpp"

namespace urban_nav_store {

class Sessions : public SessionStore {
 public:
  /// `settle` writes what other tables still have in memory, and makes them forget it: called before rows of theirs are removed.
  Sessions(Connection& connection, std::function<void()> settle)
      : connection_(connection), settle_(std::move(settle)) {}

  void put(const Session& session) override;
  std::optional<Session> find(const SessionId& id) const override;
  std::vector<Session> all() const override;
  void remove(const SessionId& id) override { remove(id, {}); }
  void clear(const SessionId& id) override;
  void put(const Anchor& anchor) override;
  std::optional<Anchor> anchor(const SessionId& id) const override;
  void put(const SessionId& id, const StoredParameter& parameter) override;
  std::vector<StoredParameter> parameters(const SessionId& id) const override;
  void put(const SessionId& id, const Property& property) override;
  std::vector<Property> properties(const SessionId& id) const override;
  void put(const SessionId& id, const Extrinsic& extrinsic) override;
  std::vector<Extrinsic> extrinsics(const SessionId& id) const override;

 private:
  void remove(const SessionId& id, const std::vector<const Table*>& but);

  Connection& connection_;
  std::function<void()> settle_;
};

}  // namespace urban_nav_store
