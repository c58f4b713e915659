// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "file/writer_lock.hpp"
#include "stores/graph.hpp"
#include "stores/inputs.hpp"
#include "stores/keyframes.hpp"
#include "stores/scans.hpp"
#include "stores/sessions.hpp"
#include "stores/states.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// What a Store is made of: the connection, and the tables behind their interfaces.
class Store::Implementation {
 public:
  Implementation(const std::string& path, Access access);

  void close();
  void commit();
  void rollback();
  void shrink();
  /// Writes what tables have in memory, and makes them forget it.
  void settle();

 private:
  std::string path_;                // before the connection: it is opened by it
  std::optional<WriterLock> lock_;  // outlives the connection

 public:
  Connection connection;
  Sessions sessions;
  Graph graph;
  Scans scans;
  Keyframes keyframes;
  Inputs inputs;
  States states;
};

}  // namespace urban_nav_store
