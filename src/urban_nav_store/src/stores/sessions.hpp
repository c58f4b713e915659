// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "schema/table_access.hpp"
#include "urban_nav_store/session_store.hpp"

namespace urban_nav_store {

class SqliteSessionStore : public SessionStore {
 public:
  /// `settle` writes and releases the rows buffered by other stores; called before rows are removed.
  SqliteSessionStore(TableAccess& tables, std::function<void()> settle) : tables_(tables), settle_(std::move(settle)) {}

  void put(const Session& session) override;
  std::optional<Session> find(const SessionId& id) const override;
  std::vector<Session> all() const override;
  void remove(const SessionId& id) override;
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
  /// Removes the rows of a session from the tables selected by `goes`, and the rows of other sessions that refer to it.
  void removeRows(const SessionId& id, const std::function<bool(const Table&)>& goes);

  TableAccess& tables_;
  std::function<void()> settle_;
};

}  // namespace urban_nav_store
