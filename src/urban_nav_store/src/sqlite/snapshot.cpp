// SPDX-License-Identifier: BSD-3-Clause
#include "sqlite/snapshot.hpp"

namespace urban_nav_store {

Snapshot::Snapshot(Connection& connection)
    : connection_(connection.writes() || connection.inTransaction() ? nullptr : &connection) {
  if (connection_ != nullptr) connection_->execute("BEGIN");
}

Snapshot::~Snapshot() {
  if (connection_ != nullptr) connection_->endReading();
}

}  // namespace urban_nav_store
