// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Trained model with which results of a session were made, by a hash of its content.
struct StoredModel {
  SessionId session;
  std::string hash;
  std::string stage;  ///< that used it: "fabmap_node"
  std::string bytes;  ///< as the stage's files have it

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
