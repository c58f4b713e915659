// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Trained model with which results of a session were computed, keyed by a hash of its content.
struct StoredModel {
  SessionId session;
  std::string hash;
  std::string stage;  ///< stage that used it: "fabmap_node"
  std::string bytes;  ///< in the file format of the stage

  static Table table() {
    Table table{"model", 2};
    table.since = 3;
    table.wide = true;
    table.kept_by_clear = true;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("hash", hash);
    columns.text("stage", stage);
    columns.blob("bytes", bytes);
  }
};

}  // namespace urban_nav_store
