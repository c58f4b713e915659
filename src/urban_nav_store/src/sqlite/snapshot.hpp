// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sqlite/connection.hpp"

namespace urban_nav_store {

/// One state of the file for all reads in a scope, whatever another program commits meanwhile.
///
/// Without it two statements see two states: rows of the one and the tally of the other do not add up, and a sound file
/// appears to be damaged. Does nothing where a transaction is open already, nor for a connection that writes: it is the
/// only writer. Rows that are still being read when the scope ends are read to their end in the same state.
class Snapshot {
 public:
  explicit Snapshot(Connection& connection);
  ~Snapshot();
  Snapshot(const Snapshot&) = delete;
  Snapshot& operator=(const Snapshot&) = delete;

 private:
  Connection* connection_;  // null where there is nothing to end
};

}  // namespace urban_nav_store
