// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "file/writer_lock.hpp"
#include "schema/table_access.hpp"
#include "sqlite/snapshot.hpp"
#include "stores/graph.hpp"
#include "stores/inputs.hpp"
#include "stores/keyframes.hpp"
#include "stores/scans.hpp"
#include "stores/sessions.hpp"
#include "stores/states.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// Components of a Store: the connection, and the interfaces of its tables.
class Store::Implementation {
 public:
  Implementation(const std::string& path, Access access);

  void close();
  void commit();
  void rollback();
  void shrink();
  /// Writes and releases the rows buffered by the stores.
  void settle();

 private:
  std::string path_;                // before the connection, which is opened with it
  std::optional<WriterLock> lock_;  // outlives the connection

 public:
  Connection connection;
  TableAccess tables;
  SqliteSessionStore sessions;
  SqliteGraphStore graph;
  SqliteScanStore scans;
  SqliteKeyframeStore keyframes;
  SqliteInputOrder inputs;
  SqliteStageStates states;

 private:
  std::optional<Snapshot> snapshot_;  // ends before the connection is closed
};

}  // namespace urban_nav_store
