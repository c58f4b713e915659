// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "sqlite/connection.hpp"

namespace urban_nav_store {

/// dump() of what a connection sees, verified row by row and session by session, whether or not the file was checked
/// before.
std::string dumpTables(Connection& connection);

}  // namespace urban_nav_store
