// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/table.hpp"

namespace urban_nav_store {

/// Consistency test of a session (urban_nav_trust::ConsistencyTest).
struct StoredTest {
  SessionId session;
  std::string name;
  std::string verdict;  ///< "passed", "failed", "corrected" (failed, with ConsistencyTest::is_corrected)
  urban_nav_core::StampNs from = 0, to = 0;
  double statistic = 0.0, degrees_of_freedom = 0.0, p_value = 1.0;
  std::string sentence, remedy;
  static Table table() {
    Table table{"test", 2};
    table.since = 9;
    return table;
  }
  void columns(Columns& columns) {
    columns.text("session", session);
    columns.text("name", name);
    columns.text("verdict", verdict);
    columns.integer("from_ns", from);
    columns.integer("to_ns", to);
    columns.real("statistic", statistic);
    columns.real("degrees_of_freedom", degrees_of_freedom);
    columns.real("p_value", p_value);
    columns.text("sentence", sentence);
    columns.text("remedy", remedy);
  }
};

}  // namespace urban_nav_store
