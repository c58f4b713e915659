// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/folder.hpp"

namespace urban_nav_store::testing {

/// Turns a store into one of an earlier schema. Tables that the schema has not, or with fewer columns, lose their rows.
void makeOlder(const std::string& path, const Folder& folder, int version);

}  // namespace urban_nav_store::testing
