// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav {

/// Parameters of the command itself: keys without a stage in front.
struct CommandParameters {
  int memory_mb;  // MB
  CommandParameters();
};
const urban_nav_core::Table<CommandParameters>& commandTable();

}  // namespace urban_nav
