// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sqlite/connection.hpp"

namespace urban_nav_store {

/// Provides one state of the file for all reads in a scope, independent of commits of other programs.
///
/// Without it, two statements may read different states: rows of one and the tally of the other do not match, and an
/// intact file appears damaged. No effect if a transaction is open, nor for a connection that writes, since it is the
/// only writer. Rows still being read at the end of the scope are read to their end in the same state.
class Snapshot {
 public:
  explicit Snapshot(Connection& connection);
  ~Snapshot();
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

 private:
  Connection* connection_;  // null if there is no transaction to end
};

}  // namespace urban_nav_store
