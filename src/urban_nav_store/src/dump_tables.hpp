// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sqlite/connection.hpp"

namespace urban_nav_store {

/// Returns the dump() of a connection's file, verified row by row and session by session even if the file has been
/// checked before.
std::string dumpTables(Connection& connection);

}  // namespace urban_nav_store
