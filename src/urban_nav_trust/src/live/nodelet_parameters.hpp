// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_trust {

/// Parameters of the nodelet except those of the tests (urban_nav_trust/parameters.hpp). One member per row of
/// nodeletTable().
struct NodeletParameters {
  std::string map_frame;
  int queue_size;  // messages
  double drain_s;  // s

  NodeletParameters();
};

const urban_nav_core::Table<NodeletParameters>& nodeletTable();

}  // namespace urban_nav_trust
